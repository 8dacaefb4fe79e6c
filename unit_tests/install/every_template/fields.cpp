#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/synthetic.hpp>

#include "parts.hpp"

namespace every_template {

namespace {

/// The order of five values, which are given as a pointer and as Views.
template <class Value>
void order(const gale::Mesh& mesh) {
  const Value values[vertices] = {3, 1, 4, 1, 5};
  const gale::VertexOrder of_pointer(mesh, values, vertices);
  const auto check = [&](const gale::VertexOrder& found) {
    for (int v = 0; v < vertices; ++v) expect(found.keys()[v] == of_pointer.keys()[v], "keys");
    expect(found.keys_in<gale::WorkerMemory>().extent(0) == vertices, "keys of workers");
  };
  const Kokkos::View<const Value*, gale::HostMemory, Kokkos::MemoryUnmanaged> host(values, vertices);
  const auto worker = Kokkos::create_mirror_view_and_copy(gale::WorkerMemory(), host);
  const Kokkos::View<Value**, Kokkos::LayoutLeft, gale::HostMemory> rows("rows", 2, vertices);
  for (int v = 0; v < vertices; ++v) rows(1, v) = values[v];
  check(gale::VertexOrder(mesh, host));
  check(gale::VertexOrder(mesh, worker));
  check(gale::VertexOrder(mesh, Kokkos::subview(rows, 1, Kokkos::ALL())));
}

template <class... Values>
void order_each(const gale::Mesh& mesh) {
  (order<Values>(mesh), ...);
}

}  // namespace

void use_fields() {
  order_each<char, signed char, unsigned char, short, unsigned short, int, unsigned, long, unsigned long, long long,
             unsigned long long, float, double>(two_tetrahedra());

  const gale::io::PointArray array{"numbers", 1, std::vector<float>{1, 2, 3}};
  expect(std::get<std::vector<float>>(gale::io::gather(array, std::vector<int>{2}).values)[0] == 3, "gather");
  const gale::io::GridPartOf<std::int32_t> narrow = gale::io::make_grid_part<std::int32_t>(3, 0, 1);
  const gale::io::GridPartOf<std::int64_t> wide = gale::io::make_grid_part(3, 0, 1);
  const gale::io::Dataset::Points<float> grid_points = wide.points;
  expect(narrow.tetrahedra.extent(0) == 48 && grid_points.extent(0) == 27, "a part of a grid");

  const gale::Separatrices<gale::Id> none;
  expect(none.count() == 0, "no separatrices");
  std::vector<int> seen(3);
  gale::on_threads(3, [&](int i) { seen[i] = i; });
  gale::in_turns(2, 3, [&](int, std::int64_t i) { seen[i] += static_cast<int>(i); });
  expect(seen[2] == 4, "threads");
}

}  // namespace every_template
