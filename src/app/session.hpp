#pragma once

#include <functional>
#include <map>
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
#include <gale/outputs/excerpt.hpp>
#include <gale/outputs/mesh_piece.hpp>
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
  outputs::ValuesOf values = outputs::ValuesOf::held_vertices;  ///< of the field
  bool is_rounded = false;  ///< on ranks: whether values that this one has read are (outputs::is_rounded)
  std::string note{};       ///< on the order; empty for none
};

/// The field that an input names, or the first of its dataset. Throws gale::Error if there is none.
io::PointArray select_field(const io::Dataset& dataset, const InputOptions& input);

/// What outputs take of a field on a mesh at the vertices that results are named in: where that is an excerpt of the
/// mesh, as on several ranks, what the owners of its vertices have, else that itself. Refers to the field.
class OnExcerpt : public outputs::AtExcerpt {
 public:
  /// Collective, see AtExcerpt.
  OnExcerpt(const Mesh& excerpt, const FieldOnMesh& on, bool field_alone = false)
      : AtExcerpt(excerpt, on.mesh, on.dataset, on.field, field_alone, on.values) {}
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
  /// ranks `files` are those that name the pieces. Of a series there is one of each for each step, or for all.
  /// `common` must outlive the session.
  enum class Outputs { of_each_step, of_all_steps };
  Session(const InputOptions& input, const CommonOptions& common, std::vector<std::string> files = {},
          Outputs outputs = Outputs::of_each_step);

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

  /// Segments and encodes, unless the mesh of the step before is the same; a grid whose segments are its own stays one.
  /// The cells are taken out of `dataset` unless they are kept. On several ranks points and arrays are there where
  /// cells are kept, or anything is to be written, and the field's values where they are: of ghosts, too, unless
  /// `owned_values` will do.
  enum class Keep { cells, values, owned_values, nothing };
  Mesh encode(io::Dataset& dataset, const SegmentationOptions& segmentation, Keep keep);

  /// All that comes before a structure: reads, selects the field that --array names, segments, encodes, and orders the
  /// vertices by the field.
  FieldOnMesh read_field(const SegmentationOptions& segmentation, Keep keep = Keep::nothing);

  /// The whole of a field that lies on several ranks, gathered on the first one, for pictures; nothing on the others.
  /// On one rank the same. Collective; throws SharedError where there is no room.
  FieldOnMesh whole(const FieldOnMesh& on) const;

  /// The structure that --structure names, preconditioned for `relations`.
  std::unique_ptr<Structure> make_structure(const StructureOption& option, const Mesh& mesh, RelationSet relations);

  /// How to compute: where `option` says, on the threads that --threads says, with a progress bar of this title.
  ComputeOptions compute(const StructureOption& option, const std::string& title) const;

  /// How to sweep: on the threads that --threads says, with a progress bar of this title.
  SweepOptions sweep(const std::string& title) const;

  /// To be called when a step of the input is done. If the input is a series, reports the step's time, seconds and
  /// result, which is none from here on, and begins the next one, if there is one: what is read and written then is its
  /// own. Returns whether there is.
  bool next_step(const Computed& computed);

  /// The time of this step.
  double time() const { return steps_[step_].time; }

  /// Whether the input is a series.
  bool is_series() const { return is_series_; }

  /// Writes make(), points, lines or a piece of a mesh, unless the path is empty: on several ranks a piece of each, and
  /// the file that names these. All files appear when the session finishes.
  template <class Make>
  void write_result(const std::string& path, const Make& make) {
    if (path.empty()) return;
    const Stopwatch watch(report_.seconds.write);
    const std::string file = named(path);
    begin_step("writing", file);
    write_one(file, make());
  }

  /// Writes the mesh with make(), arrays of its vertices, unless the path is empty: on several ranks a piece of each.
  template <class Make>
  void write_mesh(const std::string& path, const FieldOnMesh& on, const Make& make) {
    if (on.mesh.is_part()) {
      write_result(path, [&] {
        io::Dataset piece;
        detail::together(ranks_, [&] { piece = outputs::piece_of(on.order, on.dataset, make(), on.has_ids); });
        return piece;
      });
    } else {
      write(path, [&](const io::AtomicFile& file) { io::write_mesh(file, on.dataset, make()); });
    }
  }

  /// Calls write_to(file) unless the path is empty, with a file that appears when the session finishes, together with
  /// all others. On the first rank alone, while the others wait.
  template <class Write>
  void write(const std::string& path, const Write& write_to) {
    if (path.empty()) return;
    const Stopwatch watch(report_.seconds.write);
    const std::string name = named(path);
    begin_step("writing", name);
    detail::together(ranks_, [&] {
      if (ranks_.rank() != 0) return;
      store(name, write_to);
    });
  }

  /// Writes the report, with what is to say of the structure, if there was one; makes all files appear, or none, and
  /// says so.
  void finish(const Structure* structure = nullptr);

  /// Finishes, with how all was computed in the report.
  void finish(const StructureOption& option, const Computed& computed);

 private:
  io::Dataset read_any();
  Mesh encode_anew(io::Dataset& dataset, const SegmentationOptions& segmentation);

  /// Chooses what this step reads.
  void begin_reading();

  /// Says what was read.
  void say_input();

  /// The file that `path` stands for in this step; of a series, the file of name_of_series is to name it.
  std::string named(const std::string& path);

  /// Writes the files that name those of all steps.
  void write_series();

  void tell_size(std::int64_t vertices, std::int64_t cells, int dimension);
  FieldOnMesh read_part(const SegmentationOptions& segmentation, Keep keep);

  template <class Result>
  void write_one(const std::string& path, const Result& result);

  /// Adds a file, has write_to(file) write it, and waits until it is on disk.
  template <class Write>
  void store(const std::string& path, const Write& write_to) {
    const io::AtomicFile& file = files_.add(path);
    timed(report_.wall.compress, [&] { return write_to(file), 0; });
    timed(report_.wall.store, [&] { return io::AtomicFiles::sync(file), 0; });
  }

  /// Says how long it took, and how much memory.
  void tell_costs();

  /// Makes all files appear, or none; says so of the first ones.
  void appear(std::size_t results);

  /// The field that --array names, or the first; says which. A copy: once a run.
  io::PointArray select_field(const io::Dataset& dataset);

  /// Notes that values of a field are rounded.
  void note_rounded(const std::string& field);

  /// Says and reports those that haven't been.
  void note(const std::vector<std::string>& notices);

  InputOptions input_;  ///< which knows what is to be written
  const CommonOptions& common_;
  const Ranks& ranks_;
  const bool has_outputs_;  ///< beside the report
  bool is_series_ = false;
  bool numbers_files_ = false;  ///< each step has its own
  std::vector<io::Step> steps_;
  std::size_t step_ = 0;
  Console console_;
  Report report_;
  io::AtomicFiles files_;
  std::optional<Mesh> mesh_;  ///< of this step
  std::optional<Mesh> part_;  ///< on several ranks
  Seconds seconds_before_;    ///< what all steps before took

  /// The files of name_of_series by their names, each with what it is to name.
  std::map<std::string, std::vector<io::Step>> series_;
  WarmUp warm_up_;
};

}  // namespace gale::app
