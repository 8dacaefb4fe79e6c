#include <unistd.h>

#include <algorithm>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/threads.hpp>
#include <gale/runtime/defaults.hpp>

namespace gale::detail {

namespace {

/// A copy reaches the link's bandwidth from some megabytes on; more only delays the first row.
constexpr std::size_t largest_batch = 16 * mebibyte;

/// The share of the machine's memory that blocks may take. A sweep uses little of it again and again; jumps are the
/// faster the more blocks stay.
constexpr std::size_t share_of_host = 8;

std::size_t default_host_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<std::size_t>(pages) * page / share_of_host : 512 * mebibyte;
}

}  // namespace

int given_or(int given, int otherwise, const char* name) {
  if (given < 0) throw Error(std::string(name) + " must be at least 1, not " + std::to_string(given));
  return given == 0 ? otherwise : given;
}

void require_relations(RelationSet wanted) {
  if (wanted.empty()) throw Error("a structure needs at least one relation to be preconditioned for");
}

double words_per_vertex(RelationSet relations) {
  constexpr int words_of_links = 22;
  double sum = relations.has_links() ? 1 + words_of_links : 1;
  for (const Relation relation : members_of(relations)) sum += traits_of(relation).words_of_vertex;
  return sum;
}

namespace {

struct GivenCounts {
  int threads_per_segment, threads_per_block, blocks_per_request;
};

GivenCounts counts_of(const StructureOptions& options) {
  return {given_or(options.threads_per_segment, 128, "threads per segment"),
          given_or(options.threads_per_block, 256, "threads per block"),
          given_or(options.blocks_per_request, 16, "blocks per request")};
}

}  // namespace

void require_counts(const StructureOptions& options) {
  counts_of(options);
  cores(options);
}

Sizes sizes_for(const Mesh& mesh, const StructureOptions& options, int queues) {
  const auto [threads_per_segment, threads_per_block, blocks] = counts_of(options);
  const std::size_t host = host_memory(options) / queues;
  // Three batches are on the device at a time.
  const std::size_t device = options.device_memory == 0 ? largest_batch : options.device_memory / queues / 3;
  const std::size_t batch = std::clamp(std::min(host / 8, device), std::size_t(4096), largest_batch);
  Sizes sizes;
  sizes.batch_words = static_cast<Offset>(batch / sizeof(Id));
  sizes.host_bytes = host;
  const Offset per_request = Offset(blocks) * threads_per_block / threads_per_segment;
  sizes.segments_per_request = static_cast<Id>(std::clamp<Offset>(per_request, 1, std::max(mesh.segments(), Id(1))));
  sizes.threads_per_segment = (threads_per_segment + lanes_per_warp - 1) / lanes_per_warp * lanes_per_warp;
  return sizes;
}

std::size_t host_memory(const StructureOptions& options) {
  return options.host_memory == 0 ? default_host_memory() : options.host_memory;
}

int cores(const StructureOptions& options) { return given_or(options.cores, host_threads(), "cores"); }

}  // namespace gale::detail
