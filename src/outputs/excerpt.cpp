#include <array>
#include <utility>

#include <gale/base/parallel.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>
#include <gale/outputs/excerpt.hpp>

namespace gale::outputs {

namespace detail {

io::PointArray brought(const gale::detail::ExchangePlan& plan, const Ranks& ranks, const io::PointArray& array,
                       std::size_t count) {
  return std::visit(
      [&](const auto& values) -> io::PointArray {
        using Values = std::decay_t<decltype(values)>;
        using Value = typename Values::value_type;
        const std::size_t width = array.components;
        Values all;
        std::vector<Value> from, to;
        gale::detail::together(ranks, [&] {
          all = gale::detail::unwritten<Value>(count * width);
          if (width == 1) return;
          from.resize(values.size() / width);
          to.resize(count);
        });
        if (width == 1) plan(ranks, values.data(), all.data());
        for (std::size_t component = 0; width > 1 && component < width; ++component) {
          for (std::size_t i = 0; i < from.size(); ++i) from[i] = values[i * width + component];
          plan(ranks, from.data(), to.data());
          for (std::size_t i = 0; i < count; ++i) all[i * width + component] = to[i];
        }
        return {array.name, array.components, std::move(all)};
      },
      array.values);
}

}  // namespace detail

const Mesh& mesh_of_excerpt(const MorseSmaleComplex& complex) {
  gale::detail::together(complex.gradient.mesh().exchange().ranks(), [&] { complex.excerpt.gradient(); });
  return complex.excerpt.mesh();
}

io::Dataset dataset_of(const Mesh& excerpt, const Mesh& mesh, const io::Dataset& dataset) {
  const Ranks& ranks = mesh.exchange().ranks();
  const auto plan = gale::detail::plan_to(excerpt, mesh);
  io::Dataset found;
  std::visit(
      [&](const auto& points) {
        using Coordinate = typename std::decay_t<decltype(points)>::non_const_value_type;
        using Row = std::array<Coordinate, 3>;
        io::Dataset::Points<Coordinate> rows;
        gale::detail::together(ranks,
                               [&] { rows = allocate<decltype(rows)>("GALE::points_of_excerpt", excerpt.vertices()); });
        plan(ranks, reinterpret_cast<const Row*>(points.data()), reinterpret_cast<Row*>(rows.data()));
        found.points = rows;
      },
      dataset.points);
  for (const io::PointArray& array : dataset.arrays)
    found.arrays.push_back(detail::brought(plan, ranks, array, excerpt.vertices()));
  return found;
}

io::PointArray array_of(const Mesh& excerpt, const Mesh& mesh, const io::PointArray& array, ValuesOf values) {
  const Id shift = values == ValuesOf::held_vertices ? 0 : static_cast<Id>(mesh.exchange().from_givers().run().slot);
  return detail::brought(gale::detail::plan_to(excerpt, mesh, shift), mesh.exchange().ranks(), array,
                         excerpt.vertices());
}

AtExcerpt::AtExcerpt(const Mesh& excerpt, const Mesh& mesh, const io::Dataset& dataset, const io::PointArray& field,
                     bool field_alone, ValuesOf values)
    : dataset_(dataset), field_(field), is_excerpt_(!(excerpt == mesh)) {
  if (!is_excerpt_) return;
  if (!field_alone) own_dataset_ = dataset_of(excerpt, mesh, dataset);
  own_field_ = array_of(excerpt, mesh, field, values);
}

}  // namespace gale::outputs
