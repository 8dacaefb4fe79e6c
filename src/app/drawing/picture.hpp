#pragma once

#include <array>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/app/drawing/scene.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/persistence.hpp>

// What is drawn of results, as flat drawings and scenes.

namespace gale::app {

/// A persistence diagram and beside it its curve, both axes of which are logarithmic. What has a birth or a death that
/// isn't finite isn't drawn.
Flat plot_of(const std::vector<outputs::DiagramPoint>& diagram, const std::string& field);

/// A picture of a complex: the mesh without the octant of its high corner, its skin in a pale colour for each
/// Morse-Smale manifold that is as bright as `field` is high; in the octant, and all over triangles, the critical
/// simplices, as balls, and the lines of `separatrices1`, as smooth tubes: where they are many, those along which the
/// field changes most and the critical simplices that they join; and a legend. `critical` and `separatrices1` are what
/// outputs/ makes of the complex; of `numbers` only `on_surface` is read.
Scene picture_of(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
                 const SimplexNumbers& numbers, const io::PointSet& critical, const io::Surface& separatrices1);

/// The 1-separatrices that a picture shows: those of each type along which the field changes most.
struct ShownPaths {
  /// The paths of one type, smoothed, without what another one shows already.
  struct Kind {
    std::vector<std::vector<Point>> stretches;
    Id inside = 0;  ///< how many paths come inside
    Id shown = 0;   ///< how many of these are shown
  };

  std::array<Kind, 3> kinds;          ///< by SeparatrixType: descending, connectors, ascending
  std::set<std::pair<int, Id>> ends;  ///< CellDimension and CellId of the critical simplices that they join

  /// Whether every path that comes inside is shown.
  bool are_all() const;
};

/// Chooses `most` of each type among the paths of `separatrices1` that have a line with both ends `inside`, and leaves
/// out all other lines. A path that is told as far as an earlier one goes on as that one does.
ShownPaths shown_paths(const io::Surface& separatrices1, Id most, const std::function<bool(const Point&)>& inside);

/// Colours of minima, 1-saddles, 2-saddles, maxima, and of what is none of these.
inline constexpr Color color_of_critical[] = {
    {26, 89, 217}, {0, 140, 90}, {245, 150, 16}, {214, 31, 36}, {120, 120, 120}};
/// The colour of critical simplices of a dimension: those of the mesh's own are maxima.
inline const Color& color_of_simplices(const Mesh& mesh, int dimension) {
  return color_of_critical[dimension == mesh.dimension() ? 3 : dimension];
}
/// Colours of 1-separatrices, by type: descending, connectors, ascending.
inline constexpr Color color_of_type[] = {{60, 110, 225}, {110, 110, 118}, {225, 70, 60}};

/// A picture of a tree: left of it the mesh as in a picture of a complex, in a colour for each arc, with the nodes that
/// are seen as balls; beside it the tree as high as `field` is, in these colours. Where its branches are many, the most
/// persistent ones, and what hangs on them has their colours. `on_surface` as surface_vertices finds it.
Scene picture_of(const io::Dataset& dataset, const io::PointArray& field, const Mesh& mesh, const MergeTree& tree,
                 const std::string& name, const Array<const std::uint8_t, HostMemory>& on_surface);

/// Size of a picture of a complex, and the part of its width that is left of the legend.
inline constexpr int picture_width = 1200, picture_height = 800;
inline constexpr double part_left_of_legend = 0.74;

/// The legend of a picture of a complex: what it has of each kind, in which colour, and what of it is shown. `skin` are
/// colours of manifolds.
Flat legend_of(const MorseSmaleComplex& complex, const ShownPaths& shown, const std::vector<Color>& skin);

}  // namespace gale::app
