#include <algorithm>

#include <gale/runtime/computation.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale {

void require_consumers(const ComputeOptions& options) {
  if (options.consumers != ConsumerPlace::device) return;
  if (!have_device) throw Error("this gale has no device for consumers");
  if (options.make_structure) throw Error("the structure that is named computes rows for consumers on the host");
  if (options.structure.way != Way::gale)
    throw Error(std::string("the way '") + name_of(options.structure.way) +
                "' computes rows for consumers on the host");
}

namespace detail {

bool kernels_read(const Mesh& mesh, const ComputeOptions& options) {
  const Ranks& ranks = mesh.exchange().ranks();
  together(ranks, [&] {
    require_consumers(options);
    if (options.consumers == ConsumerPlace::device && !mesh.on_device())
      throw Error("no consumers can be on the device: " + mesh.notice());
  });
  const bool are_wanted =
      options.consumers == ConsumerPlace::device ||
      (options.consumers == ConsumerPlace::best && !options.make_structure && options.structure.way == Way::gale);
  return ranks.least(std::int64_t(are_wanted && mesh.on_device())) == 1;
}

DeviceSweepOptions sweep_of_kernels(const StructureOptions& options) {
  DeviceSweepOptions sweep;
  sweep.memory = options.device_memory;
  sweep.threads_per_segment = options.threads_per_segment;
  return sweep;
}

Computing::Computing(const Mesh& mesh, const ComputeOptions& options, Computed* computed)
    : mesh_(mesh),
      options_(options),
      computed_(computed != nullptr ? *computed : own_),
      limit_(options.threads),
      running_(computed_.seconds_running) {
  together(mesh.exchange().ranks(), [&] {
    require_thread_count(options.threads);
    require_consumers(options);
  });
}

void Computing::fall_back(const OutOfMemory& error) {
  computed_.on_device = false;
  computed_.notices.push_back("the sweep doesn't fit the device's memory (" + error.missing() +
                              "): consumers are on the host");
}

void Computing::tell_end() const {
  together(mesh_.exchange().ranks(), [&] { ProgressReport(mesh_.segments(), options_)(mesh_.segments()); });
}

Structure& Computing::structure(RelationSet relations) {
  auto& there = computed_.structure;
  if (there == nullptr || !(there->mesh() == mesh_) || !there->relations().contains(relations)) {
    double seconds = 0;
    {
      const Stopwatch preparing(seconds);
      there.reset();
      together(mesh_.exchange().ranks(), [&] {
        there = options_.make_structure ? options_.make_structure(mesh_, relations)
                                        : make_structure(mesh_, relations, options_.structure);
        if (there == nullptr) throw Error("the options' make_structure has made no structure");
      });
    }
    computed_.seconds_preparing += seconds;
    computed_.seconds_running -= seconds;  // which all of this is added to
  }
  return *there;
}

}  // namespace detail

}  // namespace gale
