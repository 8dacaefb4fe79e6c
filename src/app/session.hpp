#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/app/console.hpp>
#include <gale/app/options/options.hpp>
#include <gale/app/options/structure_option.hpp>
#include <gale/app/report.hpp>
#include <gale/app/step.hpp>
#include <gale/app/warm_up.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::app {

/// A scalar field on a mesh: where every analysis begins.
struct FieldOnMesh {
  io::Dataset dataset;  ///< without its tetrahedra, unless they are kept
  Mesh mesh;
  io::PointArray field;
  VertexOrder order;
};

/// One run of a command: the steps that several commands take, each timed and said.
class Session {
 public:
  /// Finds out before the work whether its `files` and the report, each if it isn't empty, can be written. Throws
  /// gale::Error for one that can't; UsageError if two of them, or one and the input, are the same file. `common`
  /// must outlive the session.
  Session(const InputOptions& input, const CommonOptions& common, std::vector<std::string> files = {});

  const Console& console() const { return console_; }
  Report& report() { return report_; }

  /// To be called before anything is read: has the device do once what the command will, while that is being read.
  /// `run` is what the command computes, unless its consumers are to be on the host.
  void warm_up(const StructureOption& option, std::function<void(const VertexOrder&)> run);

  /// Reads the input. Throws gale::Error if it hasn't the array that --array names, if it names one.
  io::Dataset read();

  /// Segments and encodes. The tetrahedra are taken out of `dataset` on the way unless they are kept.
  enum class Keep { tetrahedra, nothing };
  Mesh encode(io::Dataset& dataset, const SegmentationOptions& segmentation, Keep keep);

  /// All that comes before a structure: reads, selects the field that --array names, segments, encodes, and orders the
  /// vertices by the field.
  FieldOnMesh read_field(const SegmentationOptions& segmentation, Keep keep = Keep::nothing);

  /// The structure that --structure names, preconditioned for `relations`.
  std::unique_ptr<Structure> make_structure(const StructureOption& option, const Mesh& mesh, RelationSet relations);

  /// How to compute: where `option` says, on the threads that --threads says, with a progress bar of this title.
  ComputeOptions compute(const StructureOption& option, const std::string& title) const;

  /// How to sweep: on the threads that --threads says, with a progress bar of this title.
  SweepOptions sweep(const std::string& title) const;

  /// Calls write_to(file) unless the path is empty, with a file that appears when the session finishes, together with
  /// all others.
  template <class Write>
  void write(const std::string& path, const Write& write_to) {
    if (path.empty()) return;
    const Stopwatch watch(report_.seconds.write);
    begin_step("writing", path);
    const io::AtomicFile& file = files_.add(path);
    write_to(file);
    io::AtomicFiles::sync(file);
  }

  /// Writes the report, with what is to say of the structure, if there was one; makes all files appear, or none, and
  /// says so.
  void finish(const Structure* structure = nullptr);

  /// Finishes, with how all was computed in the report.
  void finish(const StructureOption& option, const Computed& computed);

 private:
  io::Dataset read_any();
  void appear();

  /// The field that --array names, or the first; says which. A copy: once a run.
  io::PointArray select_field(const io::Dataset& dataset);

  /// Says and reports those that haven't been.
  void note(const std::vector<std::string>& notices);

  InputOptions input_;  ///< which knows what is to be written
  const CommonOptions& common_;
  Console console_;
  Report report_;
  io::AtomicFiles files_;
  WarmUp warm_up_;
};

}  // namespace gale::app
