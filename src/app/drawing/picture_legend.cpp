#include <gale/app/console.hpp>
#include <gale/app/drawing/picture.hpp>

namespace gale::app {

namespace {

/// "1 minimum", "2,403 1-saddles"
std::string counted(std::int64_t count, const char* one, const char* several) {
  return grouped(count) + ' ' + (count == 1 ? one : several);
}

/// A legend that grows downwards.
class Legend {
 public:
  explicit Legend(int entries) {
    flat_.width = picture_width;
    flat_.height = picture_height;
    y_ = (picture_height + entries * step) / 2.0;
  }

  void add_dots(const std::vector<Color>& colors, const std::string& caption) {
    for (std::size_t i = 0; i < colors.size(); ++i)
      flat_.dots.push_back({colors[i], 15, {{left + mark / 2.0 + (i - (colors.size() - 1) / 2.0) * 13, y_}}});
    add_text(caption, 17);
  }

  void add_line(const Color& color, double width, const std::string& caption) {
    flat_.lines.push_back({color, width, 1, {{{left, y_}, {left + mark, y_}}}});
    add_text(caption, 17);
  }

  void add_text(const std::string& text, double size) {
    flat_.texts.push_back({text, {left + mark + 12, y_}, Flat::Text::Anchor::left, size});
    y_ -= size < 17 ? 0.7 * step : step;
  }

  void skip() { y_ -= step / 2.0; }

  Flat take() { return std::move(flat_); }

 private:
  static constexpr double left = part_left_of_legend * picture_width, mark = 34, step = 30;

  Flat flat_;
  double y_;
};

}  // namespace

Flat legend_of(const MorseSmaleComplex& complex, const ShownPaths& shown, const std::vector<Color>& skin) {
  static constexpr const char* names[4][2] = {
      {"minimum", "minima"}, {"1-saddle", "1-saddles"}, {"2-saddle", "2-saddles"}, {"maximum", "maxima"}};
  static constexpr const char* saddles[2] = {"saddle", "saddles"};
  const auto counts = complex.critical.counts();
  const MorseSmaleParts& parts = complex.parts;
  const Mesh& mesh = complex.gradient.mesh();
  const bool is_cut = mesh.dimension() == 3;
  Legend legend(10);
  for (int dimension = 0; dimension <= mesh.dimension(); ++dimension) {
    const auto& name = is_cut ? names[dimension] : dimension == 1 ? saddles : names[dimension == 2 ? 3 : 0];
    legend.add_dots({color_of_simplices(mesh, dimension)}, counted(counts[dimension], name[0], name[1]));
  }
  legend.skip();
  if (parts.descending_separatrices)
    legend.add_line(color_of_type[0], 5, counted(complex.descending.count(), "line to a minimum", "lines to minima"));
  if (parts.ascending_separatrices)
    legend.add_line(color_of_type[2], 5, counted(complex.ascending.count(), "line to a maximum", "lines to maxima"));
  if (is_cut && parts.saddle_connectors)
    legend.add_line(color_of_type[1], 2.5,
                    counted(complex.connectors.count(), "saddle connector", "saddle connectors"));
  if (!skin.empty() && (parts.descending_manifolds || parts.ascending_manifolds)) {
    legend.skip();
    legend.add_dots(skin, skin.size() == 1 ? "one manifold" : "a colour a manifold");
  }
  legend.skip();
  if (is_cut) {
    legend.add_text("Lines and points: in the", 14);
    legend.add_text("part that is cut away.", 14);
  }
  if (!shown.are_all()) {
    Id least = 0;
    for (const auto& kind : shown.kinds) least = std::max(least, kind.shown);
    legend.add_text("Of each kind the " + grouped(least) + " lines", 14);
    legend.add_text("along which the field", 14);
    legend.add_text("changes most.", 14);
  }
  return legend.take();
}

}  // namespace gale::app
