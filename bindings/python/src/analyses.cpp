#include "analyses.hpp"

#include <utility>

#include <gale/outputs/field.hpp>

#include "job.hpp"

namespace gale::python {

namespace {

template <class T, class Member>
nb::object column(const std::vector<outputs::DiagramPoint>& diagram, const Member& member) {
  std::vector<T> values;
  values.reserve(diagram.size());
  for (const auto& point : diagram) values.push_back(static_cast<T>(member(point)));
  return numpy_of(std::move(values));
}

}  // namespace

nb::dict numpy_of(const std::vector<outputs::DiagramPoint>& diagram) {
  using Point = outputs::DiagramPoint;
  nb::dict columns;
  columns["type"] = column<std::int8_t>(diagram, [](const Point& point) { return point.type; });
  columns["birth"] = column<double>(diagram, [](const Point& point) { return point.birth; });
  columns["death"] = column<double>(diagram, [](const Point& point) { return point.death; });
  std::vector<std::uint8_t> is_finite;
  for (const Point& point : diagram) is_finite.push_back(point.is_finite ? 1 : 0);
  columns["is_finite"] = flags_of(std::move(is_finite));
  columns["birth_vertex"] = column<Id>(diagram, [](const Point& point) { return point.begin; });
  columns["death_vertex"] = column<Id>(diagram, [](const Point& point) { return point.end; });
  return columns;
}

namespace {

nb::int_ numpy_of(Id count) { return nb::int_(count); }

}  // namespace

nb::dict results_of(std::map<std::string, outputs::Outcome> found, const std::string& note) {
  nb::dict results;
  results["note"] = text_of(note);
  for (auto& [result, outcome] : found)
    results[result.c_str()] = std::visit([](auto& one) -> nb::object { return numpy_of(std::move(one)); }, outcome);
  return results;
}

outputs::Settings settings_of(const GivenOptions& given) {
  const auto& [flags, thresholds, choices, numbers] = given;
  outputs::Settings settings{flags, {}, choices, numbers};
  for (const auto& [option, value] : thresholds) settings.thresholds[option] = {value.first, value.second};
  return settings;
}

nb::dict PyMesh::analyse(const std::string& analysis, Array1 values, const std::string& name, const GivenOptions& given,
                         int threads, const nb::object& progress, const std::optional<Array1>& given_order) const {
  Job job(progress);
  const ComputeOptions options = job.sweep_options(threads);
  const outputs::Settings settings = settings_of(given);
  std::string note;
  auto found = job.run([&] {
    const ThreadLimit limit(options.threads);
    auto copy = in_background([&] { return field_of(values, name); });
    io::Dataset dataset = with({name, 1, {}});
    io::PointArray& field = dataset.arrays.front();
    const auto await = [&] {
      if (copy.valid()) field = copy.get();
    };
    const auto find_order = [&] {
      if (!given_order) return order_of(mesh(), values);
      await();
      io::Dataset beside;
      beside.arrays.push_back(field_of(*given_order, name + "_Order", "the order"));
      return outputs::order_of(mesh(), beside, field, &note);
    };
    const VertexOrder order = find_order();
    return outputs::analysis_named(analysis).run(
        {dataset, field, order, [&](const char*, double, double) { return options; }, await}, settings);
  });
  return results_of(std::move(found), note);
}

}  // namespace gale::python
