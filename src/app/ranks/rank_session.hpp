#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gale/app/console.hpp>
#include <gale/app/options/options.hpp>
#include <gale/app/options/structure_option.hpp>
#include <gale/app/report.hpp>
#include <gale/distributed/distributed_gradient.hpp>
#include <gale/distributed/distributed_numbers.hpp>
#include <gale/distributed/distributed_order.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/write.hpp>

namespace gale::app {

/// A scalar field on a mesh that lies on several ranks. What outputs take is empty where there are none.
struct FieldOnRanks {
  DistributedMesh mesh;
  DistributedOrder order;

  // For outputs, by local input id.
  io::Dataset local;          ///< points and arrays as the input has them, without tetrahedra
  io::PointArray field;       ///< the one that is analysed
  io::PointArray order_from;  ///< what `order` was made from
  bool has_ids = false;       ///< whether GlobalPointIds of `local` are the points' in the input
};

/// One run of a command on several ranks: what Session is on one. The first rank speaks, and writes the report.
class RankSession {
 public:
  /// Throws SharedError if the files, `outputs` and the report, can't be written where they aren't empty, or if two of
  /// all that will be written, or one and the input, are the same file.
  RankSession(const InputOptions& input, const CommonOptions& common, const std::vector<std::string>& outputs);

  const Communicator& ranks() const { return ranks_; }
  const Console& console() const { return console_; }
  Report& report() { return report_; }

  /// `grid:N` is made by each rank for itself; the pieces of a .pvtu are read by all; anything else is read by the
  /// first, and dealt out. Throws SharedError.
  FieldOnRanks read_field(const SegmentationOptions& segmentation);

  /// What by_kernels() finds if consumers are to be kernels on all ranks' devices, else by_consumers(structure), with
  /// the structure that --structure names of this rank's local mesh.
  template <class ByConsumers, class ByKernels>
  auto find(const StructureOption& option, const Mesh& local, RelationSet relations, const ByConsumers& by_consumers,
            const ByKernels& by_kernels) {
    std::unique_ptr<Structure> structure;
    if (!on_device(option, local)) structure = make_structure(option, local, relations);
    const Stopwatch watch(report_.seconds.run);
    return structure ? by_consumers(*structure) : by_kernels();
  }

  DistributedGradient find_gradient(const StructureOption& option, const FieldOnRanks& on);

  /// The structure that --structure names of this rank's local mesh.
  std::unique_ptr<Structure> make_structure(const StructureOption& option, const Mesh& local, RelationSet relations);

  /// The numbers of these simplices, by a structure of their own. Timed as running.
  DistributedNumbers number(const StructureOption& option, const DistributedMesh& mesh,
                            const DistributedNamedSimplices& named);

  /// How to sweep: without a progress bar.
  SweepOptions sweep() const;

  /// A piece a rank, NAME_RANK.vtp or NAME_RANK.vtu, and the file NAME.pvtp or NAME.pvtu that names them; nothing
  /// without a path. They appear with finish().
  template <class Piece>
  void write_pieces(const std::string& path, const Piece& piece);

  /// Writes the report, and makes all files of all ranks appear once all are written.
  void finish(const DistributedMesh& mesh);

 private:
  /// What of the input they take.
  enum class Outputs { none, points, with_mesh };
  static Outputs kind_of(const std::vector<std::string>& files);

  /// Makes all files of all ranks appear, or none; says so of the first ones.
  void appear(std::size_t results);

  bool on_device(const StructureOption& option, const Mesh& local);

  InputOptions input_;  ///< which knows what is to be written
  const CommonOptions& common_;
  const Outputs outputs_;
  Communicator ranks_;
  Console console_;
  Report report_;
  io::AtomicFiles files_;
};

}  // namespace gale::app
