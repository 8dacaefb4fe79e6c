#include <algorithm>
#include <string>
#include <utility>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/grid.hpp>

namespace gale {

namespace detail {

namespace {

constexpr std::uint8_t triangles_of_square[2][4] = {{0, 1, 3, 3}, {0, 2, 3, 3}};

/// The direction from a corner of a cube to another one.
int direction_of(int from, int to) {
  const auto step = [&](int axis) { return (to >> axis & 1) - (from >> axis & 1); };
  constexpr int upward[8] = {-1, 7, 8, 9, 10, 11, 12, 13};
  const int up = step(0) + step(1) + step(2) > 0 ? 1 : -1;
  const int along = (step(0) != 0 ? 1 : 0) + (step(1) != 0 ? 2 : 0) + (step(2) != 0 ? 4 : 0);
  return up > 0 ? upward[along] : grid_directions - 1 - upward[along];
}

/// At most so many of something, without memory of their own.
template <class T, int most>
struct Few {
  T all[most];
  int count = 0;

  void push_back(const T& one) { all[count++] = one; }
  const T* begin() const { return all; }
  const T* end() const { return all + count; }
};

/// A cell of a star: the directions of its other vertices, ascending.
struct StarCell {
  int of_kind;
  Few<int, 3> directions;
};

using StarCells = Few<StarCell, 24>;

StarCells cells_of_kind(int kind, int dimension) {
  StarCells cells;
  for (int cube = 0; cube < 8; ++cube) {
    if ((kind >> cube & 1) == 0) continue;
    const int own = 7 - cube;  // the corner of the cube that the vertex is
    for (int number = 0; number < (dimension == 3 ? 6 : 2); ++number) {
      const std::uint8_t* const walk = dimension == 3 ? freudenthal[number] : triangles_of_square[number];
      if (std::find(walk, walk + dimension + 1, own) == walk + dimension + 1) continue;
      StarCell cell{8 * number + cube, {}};
      for (int k = 0; k <= dimension; ++k) {
        if (walk[k] != own) cell.directions.push_back(direction_of(own, walk[k]));
      }
      cells.push_back(cell);
    }
  }
  return cells;
}

/// Whether a facet at the vertex has one cell alone.
bool is_open(const StarCells& cells, int dimension) {
  int count[grid_directions][grid_directions] = {};
  for (const StarCell& cell : cells) {
    for (const int* i = cell.directions.begin(); i != cell.directions.end(); ++i) {
      if (dimension == 2) ++count[*i][*i];
      for (const int* k = i + 1; k != cell.directions.end() && dimension == 3; ++k) ++count[*i][*k];
    }
  }
  return std::any_of(&count[0][0], &count[0][0] + grid_directions * grid_directions, [](int n) { return n == 1; });
}

StarKind make_kind(int kind, int dimension) {
  StarKind made{};
  const StarCells cells = cells_of_kind(kind, dimension);
  for (const StarCell& cell : cells) {
    for (const int d : cell.directions) {
      made.directions = static_cast<std::uint16_t>(made.directions | 1 << d);
      for (const int other : cell.directions) {
        if (other != d) made.touching[d] = static_cast<std::uint16_t>(made.touching[d] | 1 << other);
      }
    }
  }
  std::uint8_t place[grid_directions] = {};
  for (int d = 0; d < grid_directions; ++d) {
    if ((made.directions >> d & 1) == 0) continue;
    place[d] = made.neighbours;
    made.direction[made.neighbours++] = static_cast<std::uint8_t>(d);
  }
  for (const StarCell& cell : cells) {
    for (int k = 0; k < dimension; ++k) made.link[dimension * made.cells + k] = place[cell.directions.all[k]];
    made.cell[made.cells++] = static_cast<std::uint8_t>(cell.of_kind);
  }
  made.is_open = is_open(cells, dimension);
  return made;
}

Mirrored<StarKind> make_kinds(int dimension) {
  const auto kinds = allocate<Array<StarKind, HostMemory>>("GALE::star_kinds", grid_kinds);
  for (int kind = 0; kind < grid_kinds; ++kind)
    kinds(kind) = dimension == 3 || (kind & 0x0f) == 0 ? make_kind(kind, dimension) : StarKind{};
  return kinds;
}

}  // namespace

/// Bits with their counts, for either memory.
struct CountedBits {
  Mirrored<std::uint64_t> words;
  Mirrored<Id> before, word_of;
  Id count = 0;

  template <class Memory>
  RankedBits in() const {
    return {words.in<Memory>().data(), before.in<Memory>().data(), word_of.in<Memory>().data()};
  }
};

namespace {

CountedBits count_all(const char* what, const Array<std::uint64_t, HostMemory>& words) {
  const HostExecutionSpace space;
  const Offset size = static_cast<Offset>(words.extent(0));
  const Offset all = reduce_sum("GALE::count_bits", space, size, [&](Offset w) { return count_bits(words(w)); });
  require_ids(what, all);
  const auto before = allocate<Array<Id, HostMemory>>("GALE::bits_before", size + 1);
  exclusive_scan("GALE::bits_before", space, size, before, [&](Offset w) { return count_bits(words(w)); });
  const auto word_of = allocate<Array<Id, HostMemory>>("GALE::words_of_bits", (all + 63) / 64 + 1);
  parallel_for("GALE::words_of_bits", space, size, [&](Offset w) {
    const Id sampled = (before(w) + 63) / 64;
    if (Offset(sampled) * 64 < before(w + 1)) word_of(sampled) = static_cast<Id>(w);
  });
  word_of((all + 63) / 64) = static_cast<Id>(size - 1);
  return {words, before, word_of, static_cast<Id>(all)};
}

/// A row of bits; none where there isn't one.
using BitRow = const std::uint64_t*;

/// The word of a row with each bit moved to the one before it: from x + 1 to x.
std::uint64_t from_next(BitRow row, std::size_t w, std::size_t words) {
  return row[w] >> 1 | (w + 1 < words ? row[w + 1] << 63 : 0);
}

/// The word of a row with each bit moved to the one after it: from x - 1 to x.
std::uint64_t from_last(BitRow row, std::size_t w) { return row[w] << 1 | (w > 0 ? row[w - 1] >> 63 : 0); }

}  // namespace

}  // namespace detail

struct Grid::Places {
  detail::CountedBits vertices, cubes;
};

namespace {

std::string grid_of(const std::array<Id, 3>& points) {
  return "a grid of " + std::to_string(points[0]) + " x " + std::to_string(points[1]) + " x " +
         std::to_string(points[2]) + " points";
}

void require_some_cubes(const std::array<Id, 3>& points) {
  if (points[0] < 2 || points[1] < 2 || points[2] < 1) throw Error(grid_of(points) + " has no cells");
}

}  // namespace

Grid::Grid(const std::array<Id, 3>& points) : points_(points) {
  require_some_cubes(points);
  const auto [nx, ny, nz] = points;
  // Counted in doubles: the products outgrow all integers.
  const double all = double(nx) * ny * nz, squares = (nx - 1.0) * (ny - 1.0),
               cubes = nz == 1 ? squares : squares * (nz - 1.0);
  if (all > 2147483647.0 || cubes * (nz == 1 ? 2 : 6) > 2147483647.0)
    throw Error(grid_of(points) + " has more vertices or cells than the 2147483647 that 32-bit ids can number");
  vertices_ = static_cast<Id>(all);
  cubes_ = static_cast<Id>(cubes);
  kinds_ = detail::make_kinds(dimension());
}

Interval Grid::cells_within(const Interval& some) const {
  if (some.size() == 0) return {0, 0};
  // The vertices of a cell are in the layer of its lowest one and in the next.
  const GridView view = in<HostMemory>();
  Id last = cells();
  if (some.last < vertices()) {
    const detail::GridPlace after = view.place_of_vertex(some.last);
    const Id y = dimension() == 2 ? std::max(after.y - 1, 0) : 0, z = dimension() == 2 ? 0 : std::max(after.z - 1, 0);
    last = view.cells_per_cube() * view.cubes_before(0, y, z);
  }
  return {std::min(view.first_cell(some.first), last), last};
}

bool Grid::operator==(const Grid& other) const {
  if (points_ != other.points_ || cubes_ != other.cubes_) return false;
  if (places_ == other.places_) return true;
  if (!places_ || !other.places_) return false;
  const auto mine = places_->cubes.words.in<HostMemory>(), others = other.places_->cubes.words.in<HostMemory>();
  return std::equal(mine.data(), mine.data() + mine.size(), others.data());
}

Grid::Grid(const std::array<Id, 3>& points, const Array<std::uint64_t, HostMemory>& inside) : points_(points) {
  require_some_cubes(points);
  const std::size_t nx = points[0], ny = points[1], nz = points[2], words = words_of_row(points[0]), rows = ny * nz;
  if (inside.extent(0) != words * rows)
    throw Error("the points of a grid have " + std::to_string(inside.extent(0)) + " words of bits, not " +
                std::to_string(words * rows));
  if (nx % 64 != 0) {
    const auto end = static_cast<Offset>(rows);
    const Offset wrong = reduce_min("GALE::bits_behind_rows", HostExecutionSpace(), end, end, [&](Offset row) {
      return inside((row + 1) * words - 1) >> (nx % 64) != 0 ? row : end;
    });
    if (wrong != end)
      throw Error("row " + std::to_string(wrong) + " of a grid has bits behind its " + std::to_string(nx) + " points");
  }
  const bool is_plane = nz == 1;
  require_ids("rows of points", static_cast<Offset>(rows + 1));
  const std::size_t all = (rows + 1) * words;  // a row behind the last stands for those that aren't there
  const auto cubes = allocate<Array<std::uint64_t, HostMemory>>("GALE::cube_bits", all);
  const auto vertices = allocate<Array<std::uint64_t, HostMemory>>("GALE::vertex_bits", all);
  parallel_for("GALE::cube_bits", HostExecutionSpace(), rows + 1, [&](Offset row) {
    std::uint64_t* const to = &cubes(row * words);
    const std::size_t y = row % ny, z = row / ny;
    if (z == nz || y + 1 == ny || (!is_plane && z + 1 == nz)) return static_cast<void>(std::fill_n(to, words, 0));
    const detail::BitRow a = &inside(row * words), b = a + words, c = is_plane ? a : a + ny * words, d = c + words;
    for (std::size_t w = 0; w < words; ++w) {
      to[w] = a[w] & b[w] & c[w] & d[w] & detail::from_next(a, w, words) & detail::from_next(b, w, words) &
              detail::from_next(c, w, words) & detail::from_next(d, w, words);
    }
  });
  parallel_for("GALE::vertex_bits", HostExecutionSpace(), rows + 1, [&](Offset row) {
    std::uint64_t* const to = &vertices(row * words);
    std::fill_n(to, words, 0);
    if (static_cast<std::size_t>(row) == rows) return;
    const std::size_t y = row % ny, z = row / ny;
    const auto add = [&](bool exists, Offset from) {
      if (!exists) return;
      const detail::BitRow cube = &cubes(from * words);
      for (std::size_t w = 0; w < words; ++w) to[w] |= cube[w] | detail::from_last(cube, w);
    };
    const Offset layer = static_cast<Offset>(ny);
    add(true, row);
    add(y > 0, row - 1);
    add(z > 0, row - layer);
    add(y > 0 && z > 0, row - layer - 1);
  });
  Places places{detail::count_all("vertices", vertices), detail::count_all("cubes", cubes)};
  require_ids(is_plane ? "triangles" : "tetrahedra", Offset(places.cubes.count) * (is_plane ? 2 : 6));
  vertices_ = places.vertices.count;
  cubes_ = places.cubes.count;
  const bool is_whole = static_cast<std::size_t>(cubes_) == (nx - 1) * (ny - 1) * (is_plane ? 1 : nz - 1);
  if (!is_whole) places_ = std::make_shared<const Places>(std::move(places));
  kinds_ = detail::make_kinds(dimension());
}

template <class Memory>
GridView Grid::in() const {
  GridView view;
  view.nx = points_[0];
  view.ny = points_[1];
  view.nz = points_[2];
  view.dimension = dimension();
  if (!is_whole()) {
    view.row = 64 * static_cast<Offset>(words_of_row(points_[0]));
    view.vertices = places_->vertices.in<Memory>();
    view.cubes = places_->cubes.in<Memory>();
  }
  return view;
}

#define GALE_INSTANTIATE(Space) template GALE_EXPORT GridView Grid::in<MemoryOf<Space>>() const
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale
