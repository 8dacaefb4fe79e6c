#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include <gale/algorithms/gradient/grid_pairs.hpp>
#include <gale/algorithms/simplify_field/changed_stars.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/stop.hpp>
#include <gale/mesh/grid.hpp>

namespace gale::detail {

namespace {

/// Turns lengths into where rows begin, and puts the parts of all threads one after the other.
void join(std::vector<std::vector<Id>>& parts, std::vector<Offset>& begin, std::vector<Id>& all) {
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  all.clear();
  all.reserve(begin.back());
  for (auto& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
    part = {};
  }
}

}  // namespace

ChangedStars::ChangedStars(const Mesh& mesh, std::function<Structure&()> structure)
    : mesh_(mesh), structure_(std::move(structure)), place_(mesh.vertices()) {}

void ChangedStars::gather(std::vector<Id> vertices, int threads) {
  vertices_ = std::move(vertices);
  const auto count = static_cast<Offset>(vertices_.size());
  // Each thread has its own rows and links first.
  std::vector<std::vector<Id>> parts(threads), links(threads);
  for (auto* const begin : {&row_begin_, &link_begin_}) begin->assign(count + 1, 0);
  shapes_.resize(count);
  Structure* const structure = structure_ ? &structure_() : nullptr;
  for_parts("GALE::rows_of_changed", count, threads, [&](int part, Offset begin, Offset end) {
    const auto keep = [&](Offset i, const Row& row, const LinkRow& link) {
      place_[vertices_[i]] = static_cast<Id>(i);
      parts[part].insert(parts[part].end(), row.begin(), row.end());
      row_begin_[i + 1] = row.size();
      shapes_[i] = link;
      const std::size_t bytes = std::size_t(link.others) * link.count * link.width;
      link_begin_[i + 1] = static_cast<Offset>((bytes + sizeof(Id) - 1) / sizeof(Id));
      auto& words = links[part];
      words.resize(words.size() + link_begin_[i + 1]);
      if (bytes > 0) std::memcpy(words.data() + words.size() - link_begin_[i + 1], link.places, bytes);
    };
    if (structure == nullptr) {
      const StarKind* const kinds = mesh_.grid()->kinds_in<HostMemory>();
      GridCursor at(mesh_.grid()->in<HostMemory>());
      GridStarRows rows;
      for (Offset i = begin; i < end; ++i) {
        stop_if_asked_at(i);
        at.go_to(vertices_[i]);
        const VertexStar star = rows.at(at, kinds[at.kind()], mesh_.dimension());
        keep(i, star.neighbours, star.link);
      }
    } else {
      const auto consumer = structure->consumer();
      for (Offset i = begin; i < end; ++i) {
        stop_if_asked_at(i);
        const Row row = consumer->row(Relation::VV, vertices_[i]);
        keep(i, row, consumer->link(vertices_[i]));
      }
    }
  });
  join(parts, row_begin_, rows_);
  join(links, link_begin_, links_);
}

}  // namespace gale::detail
