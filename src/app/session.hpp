#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/app/console.hpp>
#include <gale/app/machine.hpp>
#include <gale/app/options.hpp>
#include <gale/app/report.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/mesh/ranks.hpp>
#include <gale/mesh/segmentation.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::app {

/// A scalar field on a mesh: where every analysis begins. On several ranks it is what this one has; the dataset, and
/// the field's values, are empty then where no output takes them.
struct FieldOnMesh {
  io::Dataset dataset;  ///< by input ids of the mesh; without its cells, unless they are kept
  Mesh mesh;
  io::PointArray field;
  VertexOrder order;
  bool has_ids = false;  ///< whether GlobalPointIds of the dataset are the points' in the input of all ranks
};

/// The segments that the options give the dataset's vertices: by an array, or at random. Without options those of the
/// array of segments that the input brings; nothing where there is none. Says which array was taken; adds a line to
/// `notices` about each that was ignored. Throws gale::Error for an array that isn't there or holds no segments.
std::optional<Segmentation> segmentation_given(const io::Dataset& dataset, const SegmentationOptions& options,
                                               const Console& console, std::vector<std::string>& notices);

/// Segments them by an octree.
Segmentation make_octree(const io::Dataset& dataset, const SegmentationOptions& options);

/// One run of a command: the steps that several commands take, each timed and said. On several ranks all take them
/// together: the first one speaks, and writes the report, and each writes a piece of every output. What fails on one
/// throws SharedError on all.
class Session {
 public:
  /// Finds out before the work whether its `files` and the report, each if it isn't empty, can be written. Throws
  /// gale::Error for one that can't; UsageError if two of them, or one and the input, are the same file. On several
  /// ranks `files` are those that name the pieces. `common` must outlive the session.
  Session(const InputOptions& input, const CommonOptions& common, std::vector<std::string> files = {});

  const Ranks& ranks() const { return ranks_; }
  const Console& console() const { return console_; }
  Report& report() { return report_; }

  /// Says a result, and reports it under `key`.
  void tell(const std::string& name, const char* key, std::int64_t count) {
    console_.say(name, grouped(count));
    report_.result[key] = count;
  }
  void tell(const std::string& name, const char* key, const std::string& text) {
    console_.say(name, text);
    report_.result[key] = text;
  }

  /// To be called before anything is read: has the device do once what the command will, while that is being read.
  /// `run` is what the command computes, unless its consumers are to be on the host.
  void warm_up(const StructureOption& option, std::function<void(const VertexOrder&)> run);

  /// Reads the input. Throws gale::Error if it hasn't the array that --array names, if it names one.
  io::Dataset read();

  /// Segments and encodes; a grid whose segments are its own stays one. The cells are taken out of `dataset` on the way
  /// unless they are kept: then it has them written out.
  enum class Keep { cells, nothing };
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

  /// Writes make(), points, lines or a piece of a mesh, unless the path is empty: on several ranks a piece of each, and
  /// the file that names these. All files appear when the session finishes.
  template <class Make>
  void write_result(const std::string& path, const Make& make) {
    if (path.empty()) return;
    const Stopwatch watch(report_.seconds.write);
    begin_step("writing", path);
    write_one(path, make());
  }

  /// Calls write_to(file) unless the path is empty, with a file that appears when the session finishes, together with
  /// all others. On one rank.
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
  Mesh make_mesh(io::Dataset& dataset, const SegmentationOptions& segmentation);
  io::Dataset read_any();
  void tell_size(std::int64_t vertices, std::int64_t cells, int dimension);
  FieldOnMesh read_part(const SegmentationOptions& segmentation, Keep keep);

  template <class Result>
  void write_one(const std::string& path, const Result& result);

  /// Says how long it took, and how much memory.
  void tell_costs();
  nlohmann::ordered_json differences_of_ranks() const;

  /// Makes all files appear, or none; says so of the first ones.
  void appear(std::size_t results);

  /// The field that --array names, or the first; says which. A copy: once a run.
  io::PointArray select_field(const io::Dataset& dataset);

  /// Says and reports those that haven't been.
  void note(const std::vector<std::string>& notices);

  InputOptions input_;  ///< which knows what is to be written
  const CommonOptions& common_;
  const Ranks& ranks_;
  const bool has_outputs_;  ///< beside the report
  Console console_;
  Report report_;
  io::AtomicFiles files_;
  std::optional<Mesh> part_;  ///< on several ranks
  WarmUp warm_up_;
};

}  // namespace gale::app
