#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/runtime/structure.hpp>
#include <gale/runtime/sweep_options.hpp>

namespace gale {

/// Where the consumers of an analysis may be.
enum class ConsumerPlace {
  best,   ///< kernels where the mesh is on a device, the way is Way::gale and memory suffices; else threads of the host
  host,   ///< threads of the host
  device  ///< kernels on the device that the mesh is on, or nowhere
};

/// How an analysis computes. No result depends on it.
struct ComputeOptions : SweepOptions {
  ConsumerPlace consumers = ConsumerPlace::best;  ///< where rows are read

  /// The structure that consumers on the host read. For kernels `device_memory` and `threads_per_segment` count.
  StructureOptions structure;

  /// Makes that structure, whatever `structure.way` says, for consumers on the host; none: gale::make_structure does.
  std::function<std::unique_ptr<Structure>(const Mesh&, RelationSet)> make_structure;
};

/// How one or several analyses of a mesh were computed, one after the other: each adds to it what it did. An analysis
/// that needs a structure reads the one that is here, if it is of the same mesh and has the relations; else it makes
/// one, and leaves it here for the next. On one rank's part of a mesh all of this is collective.
struct Computed {
  bool on_device = false;                ///< whether kernels read the rows of the latest analysis that kernels can do
  std::shared_ptr<Structure> structure;  ///< what threads of the host read; null as long as nobody needed one
  std::vector<std::string> notices;      ///< one line each about what was done differently than hoped for, and why
  double seconds_preparing = 0;          ///< spent on making structures
  double seconds_running = 0;            ///< spent on all else
};

/// Throws gale::Error where `options` want consumers on a device, and there is none, or the way that they name computes
/// rows for the host. What computes asks this first; doors ask it before the mesh is read.
GALE_EXPORT void require_consumers(const ComputeOptions& options);

namespace detail {

/// Are consumers to be kernels on the device that the mesh is on? Throws gale::Error where `options` want that by name,
/// and the mesh isn't there. Of a mesh on several ranks it is collective: where one rank's part isn't on a device,
/// nobody's consumers are.
GALE_EXPORT bool kernels_read(const Mesh& mesh, const ComputeOptions& options);

/// How these go through the mesh.
GALE_EXPORT DeviceSweepOptions sweep_of_kernels(const StructureOptions& options);

/// One analysis under way: it chooses who reads its rows, and adds to what is told of it.
class GALE_EXPORT Computing {
 public:
  /// Begins; until it ends, loops of this thread keep to options.threads. `computed` may be null; both must outlive it.
  /// Throws as require_consumers does, and for threads that nobody can have: of a mesh on several ranks it is
  /// collective.
  Computing(const Mesh& mesh, const ComputeOptions& options, Computed* computed);
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;

  /// What by_kernels(sweep) finds, with DeviceSweepOptions, where consumers are to be on the device; else, or if that
  /// throws OutOfMemory and nobody asked for a device by name, what by_threads(structure) finds, with a structure that
  /// has the `relations`.
  template <class ByKernels, class ByThreads>
  auto find(RelationSet relations, const ByKernels& by_kernels, const ByThreads& by_threads) {
    return find_on(kernels_read(mesh_, options_), relations, by_kernels, by_threads);
  }

  /// find(), where it is known whether kernels are to try.
  template <class ByKernels, class ByThreads>
  auto find_on(bool device, RelationSet relations, const ByKernels& by_kernels, const ByThreads& by_threads) {
    return find_alone_on(device, by_kernels, [&] { return by_threads(structure(relations)); });
  }

  /// Whether the mesh is a grid of which everything is computed, as nobody says which structure is to be read.
  bool is_of_grid() const {
    return mesh_.grid() != nullptr && options_.structure.way == Way::gale && !options_.make_structure;
  }

  /// find() without a structure: by_threads() needs none.
  template <class ByKernels, class ByThreads>
  auto find_alone(const ByKernels& by_kernels, const ByThreads& by_threads) {
    return find_alone_on(kernels_read(mesh_, options_), by_kernels, by_threads);
  }

  /// A structure that has the relations: the one that is there, or a new one.
  Structure& structure(RelationSet relations);

 private:
  template <class ByKernels, class ByThreads>
  auto find_alone_on(bool device, const ByKernels& by_kernels, const ByThreads& by_threads) {
    computed_.on_device = device;
    if (device) {
      try {
        auto found = by_kernels(sweep_of_kernels(options_.structure));
        tell_end();
        return found;
      } catch (const OutOfMemory& error) {
        if (options_.consumers == ConsumerPlace::device) throw;
        fall_back(error);
      }
    }
    return by_threads();
  }

  void fall_back(const OutOfMemory& error);

  /// Tells options.progress that all is done, after kernels, which tell nothing meanwhile. Collective.
  void tell_end() const;

  const Mesh mesh_;
  const ComputeOptions& options_;
  Computed own_;  ///< where nobody wants to know
  Computed& computed_;
  const ThreadLimit limit_;
  const Stopwatch running_;
};

}  // namespace detail

}  // namespace gale
