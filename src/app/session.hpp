#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/app/console.hpp>
#include <gale/app/options.hpp>
#include <gale/app/report.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::app {

/// A scalar field on a mesh: where every analysis begins.
struct FieldOnMesh {
  io::Dataset dataset;  ///< without its tetrahedra, unless they are kept
  Mesh mesh;
  VertexOrder order;
};

/// One run of the command: what every subcommand does, each step timed and said.
class Session {
 public:
  /// Throws gale::Error if the report or one of `files`, which are written through VTK where they aren't empty, can't
  /// be written where they should be; UsageError if two of all files are one.
  Session(const Options& options, const std::vector<std::string>& files);

  /// Of a command that writes the files that its options name.
  explicit Session(const Options& options) : Session(options, {options.output, options.arrows}) {}

  const Options& options() const { return options_; }
  const Console& console() const { return console_; }
  Report& report() { return report_; }

  /// Reads the input.
  io::Dataset read();

  /// Segments and encodes. The tetrahedra are taken out of `dataset` on the way unless they are kept.
  enum class Keep { tetrahedra, nothing };
  Mesh encode(io::Dataset& dataset, Keep keep);

  /// All that comes before a structure: reads, segments, encodes, and orders the vertices by the field that --array
  /// names.
  FieldOnMesh read_field(Keep keep = Keep::nothing);

  /// The structure that --structure names, preconditioned for `relations`.
  std::unique_ptr<Structure> make_structure(const Mesh& mesh, RelationSet relations);

  SweepOptions sweep(const std::string& title) const;

  /// Calls write_to(path) unless the path is empty, and says what it wrote.
  template <class Write>
  void write(const std::string& path, const Write& write_to) {
    if (path.empty()) return;
    {
      const Stopwatch watch(report_.seconds.write);
      write_to(path);
    }
    console_.say("wrote", path);
  }

  /// Says the times and writes the report. `structure` as far as there is one.
  void finish(const Structure* structure);

 private:
  /// The array that the dataset is segmented by, or nullptr for an octree.
  const io::PointArray* given_segments(const io::Dataset& dataset) const;
  Segmentation segment(const io::Dataset& dataset);
  void count_simplices(const Structure& structure);

  const Options& options_;
  Console console_;
  Report report_;
};

/// Throws UsageError unless the file that an option names, if it does, ends in one of `extensions`, in either case.
/// `option` is what to call it.
void require_extension(const Options& options, const std::string& option, const std::string& file,
                       std::initializer_list<const char*> extensions);

/// The same of --output.
void require_extension(const Options& options, std::initializer_list<const char*> extensions);

}  // namespace gale::app
