#include <initializer_list>

#include <gale/mesh/cells/cell_shapes.hpp>
#include <gale/mesh/cells/cell_types.hpp>

namespace gale::detail {

namespace {

using Faces = std::initializer_list<std::initializer_list<int>>;

CellShape shape_of(int first, int end, const Faces& faces) {
  CellShape shape;
  shape.first = static_cast<std::uint8_t>(first);
  shape.end = static_cast<std::uint8_t>(end);
  int at = 0;
  for (const auto& face : faces) {
    for (const int corner : face) shape.corners[at++] = static_cast<std::uint8_t>(corner);
    shape.face_begin[++shape.faces] = static_cast<std::uint8_t>(at);
  }
  return shape;
}

CellRules rules_for(int corners) {
  CellRules rules;
  for (int number = 0; number < 256; ++number) {
    const CellType* const type = find_cell_type(number);
    if (type == nullptr) continue;
    rules.rule[number] = type->dimension < corners - 1 ? CellRule::skip : CellRule::refuse;
    rules.points[number] = static_cast<std::uint8_t>(type->points);
  }
  return rules;
}

CellRules rules_for_triangles() {
  CellRules rules = rules_for(3);
  rules.rule[cell_type::triangle] = CellRule::simplex;
  rules.rule[cell_type::quad] = rules.rule[cell_type::polygon] = CellRule::fan;
  rules.rule[cell_type::pixel] = CellRule::pixel;
  rules.rule[cell_type::triangle_strip] = CellRule::strip;
  rules.rule[cell_type::quadratic_triangle] = CellRule::quadratic_triangle;
  return rules;
}

CellRules rules_for_tetrahedra() {
  CellRules rules = rules_for(4);
  std::uint8_t shapes = 0;
  const auto add = [&](int type, const CellShape& shape) {
    rules.rule[type] = type == cell_type::quadratic_tetrahedron ? CellRule::quadratic_cone : CellRule::cone;
    rules.shape[type] = shapes;
    rules.shapes[shapes++] = shape;
  };
  rules.rule[cell_type::tetrahedron] = CellRule::simplex;
  rules.rule[cell_type::polyhedron] = CellRule::polyhedron;
  add(cell_type::hexahedron,
      shape_of(0, 8, {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}));
  add(cell_type::voxel,
      shape_of(0, 8, {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}));
  add(cell_type::wedge, shape_of(0, 6, {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}));
  add(cell_type::pyramid, shape_of(0, 5, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
  add(cell_type::pentagonal_prism,
      shape_of(
          0, 10,
          {{0, 4, 3, 2, 1}, {5, 6, 7, 8, 9}, {0, 1, 6, 5}, {1, 2, 7, 6}, {2, 3, 8, 7}, {3, 4, 9, 8}, {4, 0, 5, 9}}));
  add(cell_type::hexagonal_prism, shape_of(0, 12,
                                           {{0, 5, 4, 3, 2, 1},
                                            {6, 7, 8, 9, 10, 11},
                                            {0, 1, 7, 6},
                                            {1, 2, 8, 7},
                                            {2, 3, 9, 8},
                                            {3, 4, 10, 9},
                                            {4, 5, 11, 10},
                                            {5, 0, 6, 11}}));
  add(cell_type::quadratic_tetrahedron,
      shape_of(4, 10, {{4, 8, 7}, {5, 9, 8}, {6, 7, 9}, {6, 5, 4}, {4, 7, 6}, {5, 8, 4}, {6, 9, 5}, {8, 9, 7}}));
  return rules;
}

}  // namespace

const CellRules& cell_rules(int corners) {
  static const CellRules triangles = rules_for_triangles(), tetrahedra = rules_for_tetrahedra();
  return corners == 3 ? triangles : tetrahedra;
}

}  // namespace gale::detail
