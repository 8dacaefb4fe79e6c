#pragma once

#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/persistence.hpp>
#include <gale/runtime/computation.hpp>

// Each analysis of a field, described once and run in one way. The command's options, Python's arguments and the
// properties of VTK's and ParaView's filters are made from these descriptions, or tested against them.

namespace gale::outputs {

/// What users may say of an analysis, beside what they may say of any: mesh, field, threads, where to compute.
struct AnalysisOption {
  /// A switch; a persistence below which something happens, which isn't given by default; one of some words, the first
  /// by default; a whole number of at least 0, which is the default; or a coordinate, alone or with a scale as z:0.5,
  /// which isn't given by default.
  enum class Kind { flag, threshold, choice, number, axis };

  std::string name;           ///< with underscores, as in Python; the command has --name, or --no-name to switch it off
  Kind kind = Kind::flag;     ///< what its values are
  bool is_on = false;         ///< whether a flag is on by default
  std::string property;       ///< its name among the properties of filters; empty where they haven't got it
  std::string help;           ///< what is done where it is on or given, without a full stop
  bool has_own_file = false;  ///< in the command it names the file that a result is written to
  std::vector<std::string> choices = {};  ///< the words of a choice
};

/// An array of a result, beside those of the input that travel along.
struct AnalysisArray {
  std::string name;    ///< as users of TTK know it; NAME is the field's, also at the beginning
  std::string type;    ///< "int8", "uint8", "int32", "double"; or "field", "points": float where those are, else double
  int components = 1;  ///< numbers in each of its rows
};

/// Something that an analysis finds.
struct AnalysisResult {
  /// What a result is made of; `mesh`: arrays of the mesh's own points; `table`: columns.
  enum class Shape { points, lines, polygons, diagram, mesh, count, table };

  std::string name;                         ///< "separatrices1"
  Shape shape;                              ///< what it is
  std::string help;                         ///< what it has, without a full stop
  std::vector<AnalysisArray> point_arrays;  ///< in their order; of a table its columns
  std::vector<AnalysisArray> cell_arrays;   ///< arrays of the cells of lines and polygons, in their order
  std::string only_with;                    ///< the flag without which it isn't there; empty where it always is
};

/// What users say of an analysis's options.
struct Settings {
  std::map<std::string, bool> flags;                ///< by the option's name; defaults of those that aren't here
  std::map<std::string, Persistence> thresholds;    ///< by the option's name: the given ones
  std::map<std::string, std::string> choices = {};  ///< by the option's name; defaults of those that aren't here
  std::map<std::string, int> numbers = {};          ///< by the option's name; 0 for those that aren't here
};

/// What an analysis is run on.
struct AnalysisInput {
  const io::Dataset& dataset;   ///< points, and the arrays that travel along; cells aren't read
  const io::PointArray& field;  ///< whose values `order` has
  const VertexOrder& order;     ///< orders the vertices of the mesh that is analysed

  /// How to compute what comes next, which takes the progress of all from `begin` to `end`, in 0 to 1.
  std::function<ComputeOptions(const char* what, double begin, double end)> next;

  /// Called before a value of `dataset` or `field` is read, if it is there: who brings them while it is computed waits
  /// here.
  std::function<void()> await = nullptr;
};

/// A result: points, lines or polygons, a diagram, arrays of the mesh's points in input order, or how many there are.
using Outcome = std::variant<io::PointSet, io::Surface, std::vector<DiagramPoint>, std::vector<io::PointArray>, Id>;

/// What there is to know of an analysis.
struct GALE_EXPORT Analysis {
  std::string name;                     ///< "critical-points": the command's
  std::string help;                     ///< what it does, without a full stop
  std::vector<AnalysisOption> options;  ///< its own
  std::vector<AnalysisResult> results;  ///< all that it can have; counts come last

  /// Finds the results, by their names. To be called by run().
  std::function<std::map<std::string, Outcome>(const AnalysisInput&, const Settings&, Computed&)> find;

  /// The option of that name. Throws gale::Error for any other.
  const AnalysisOption& option(const std::string& option_name) const;

  /// The results that `settings` ask for, by their names. Throws gale::Error for a setting that it has no option for,
  /// and as what it calls.
  std::map<std::string, Outcome> run(const AnalysisInput& input, Settings settings = {}) const;
};

/// All of them, in the order of the command's help.
GALE_EXPORT const std::vector<Analysis>& analyses();

/// The one of that name. Throws gale::Error for any other.
GALE_EXPORT const Analysis& analysis_named(const std::string& name);

/// Tracks of extrema (`ExtremumTracker`), described as the others are; but they are of several steps, so they are none
/// of all analyses, nor is this to be run.
GALE_EXPORT const Analysis& tracking();

}  // namespace gale::outputs
