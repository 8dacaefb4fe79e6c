#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>

#include <gale/app/ranks/shared_input.hpp>
#include <gale/app/session.hpp>
#include <gale/io/cells/join.hpp>
#include <gale/io/write.hpp>
#include <gale/mesh/cells/split_cells.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/mesh/exchange/places.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

using GlobalIds = Array<GlobalId, HostMemory>;

/// Chooses the pieces that this rank reads.
io::PieceNames share_of(const io::PieceNames& all, const Ranks& ranks) {
  const auto count = static_cast<Offset>(all.sources.size());
  const auto begin = [&](int rank) { return all.sources.begin() + (count * rank + ranks.size() - 1) / ranks.size(); };
  return {{begin(ranks.rank()), begin(ranks.rank() + 1)}, all.point_ids, all.cell_ids};
}

/// For each of this rank's ids, which ascend, its place among those of all ranks; with `all_differ`, ids that several
/// ranks have count for each. Collective.
GlobalIds places_of(const Ranks& ranks, const std::vector<std::int64_t>& ids, bool all_differ) {
  Array<detail::SimplexKey, HostMemory> keys;
  detail::together(ranks, [&] {
    keys = detail::tabulated<detail::SimplexKey>("GALE::keys_of_ids", static_cast<Offset>(ids.size()), [&](Offset i) {
      return detail::SimplexKey{ids[i], all_differ ? ranks.rank() : 0, all_differ ? i : 0};
    });
  });
  return detail::places_of_keys(ranks, keys).places;
}

/// Gives the bits of coordinates as doubles, so that equal points have equal ones.
std::array<GlobalId, 3> bits_of(const detail::Point& point) {
  std::array<GlobalId, 3> bits;
  for (int axis = 0; axis < 3; ++axis) {
    const double coordinate = point[axis] + 0.0;  // 0 and -0 are one
    std::memcpy(&bits[axis], &coordinate, sizeof(double));
  }
  return bits;
}

/// Ids of points by coordinates: those that no lower rank has are counted from rank to rank. Those of one rank differ.
/// Collective.
GlobalIds merged_ids(const Ranks& ranks, const Array<detail::Point, HostMemory>& points) {
  struct Question {
    std::array<GlobalId, 3> bits;
    Id place;
  };
  const Offset count = points.extent(0);
  const auto home = [&](const std::array<GlobalId, 3>& bits) {
    std::uint64_t hash = 0;
    for (const GlobalId word : bits) hash = (hash ^ static_cast<std::uint64_t>(word)) * 0x9e3779b97f4a7c15u;
    return static_cast<int>((hash >> 33) % static_cast<std::uint64_t>(ranks.size()));
  };
  Array<Id, HostMemory> members;
  const auto sent = detail::collect_by_rank<Question>(
      ranks, "GALE::asked_points", count, [&](Id i) { return home(bits_of(points(i))); },
      [&](Id i) {
        return Question{bits_of(points(i)), i};
      },
      &members);
  const auto received = detail::exchange(ranks, "GALE::points_to_merge", sent);
  // Where each point occurs first: the lowest rank, and the place among its points.
  struct First {
    int rank;
    Id place;
  };
  detail::EntriesByRank<First> told, answers;
  detail::together(ranks, [&] {
    told = detail::room_by_rank<First>("GALE::told_points", detail::counts_of(received));
    answers = detail::room_by_rank<First>("GALE::found_points", detail::counts_of(sent));
    std::vector<Id> sorted(received.count());
    for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = static_cast<Id>(i);
    std::sort(sorted.begin(), sorted.end(), [&](Id a, Id b) {
      const auto &left = received.entries(a).bits, &right = received.entries(b).bits;
      return left != right ? left < right : a < b;
    });
    Id first = no_id;
    for (const Id i : sorted) {
      if (first == no_id || received.entries(i).bits != received.entries(first).bits) first = i;
      told.entries(i) = {received.rank_of(first), received.entries(first).place};
    }
  });
  detail::exchange(ranks, told, answers);
  GlobalIds ids;
  Offset fresh = 0;
  detail::together(ranks, [&] {
    ids = allocate<GlobalIds>("GALE::merged_ids", count);
    Kokkos::deep_copy(ids, GlobalId(-1));
    std::vector<bool> is_fresh(count);
    for (Offset k = 0; k < count; ++k) is_fresh[members(k)] = answers.entries(k).rank == ranks.rank();
    for (Offset i = 0; i < count; ++i) {
      if (is_fresh[i]) ids(i) = fresh++;
    }
  });
  const GlobalId first_id = ranks.sum_before(fresh);
  for (Offset i = 0; i < count; ++i) ids(i) += ids(i) < 0 ? 0 : first_id;
  // The others have the id that the rank has given them where they occur first.
  std::vector<Id> others;
  for (Offset k = 0; k < count; ++k) {
    if (answers.entries(k).rank != ranks.rank()) others.push_back(static_cast<Id>(k));
  }
  const auto found = detail::ask<GlobalId>(
      ranks, "GALE::told_ids", static_cast<Offset>(others.size()),
      [&](Id i) { return answers.entries(others[i]).rank; }, [&](Id i) { return answers.entries(others[i]).place; },
      [&](Id place) { return ids(place); });
  for (std::size_t i = 0; i < others.size(); ++i) ids(members(others[i])) = found(i);
  return ids;
}

/// The arrays that all ranks with points have, of the same types; notices about others. Collective.
void keep_common(const Ranks& ranks, io::Dataset& mesh, Offset points) {
  std::vector<io::PointArray> common;
  bool any = false;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    const std::string text = ranks.broadcast(points > 0 ? described(mesh.arrays) : "", rank);
    const bool has_points = ranks.least(std::int64_t(rank != ranks.rank() || points > 0)) == 1;
    if (!has_points) continue;
    std::vector<io::PointArray> theirs = empty_arrays(text);
    if (!std::exchange(any, true)) {
      common = std::move(theirs);
      continue;
    }
    const auto in_common = io::detail::by_kind(common), in_theirs = io::detail::by_kind(theirs);
    const auto is_missing = [&](const io::detail::ArraysByKind& arrays, const io::PointArray& array) {
      const bool is_there = io::detail::find_alike(arrays, array) != nullptr;
      if (!is_there) mesh.notices.push_back(io::detail::note_missing(array));
      return !is_there;
    };
    for (const io::PointArray& array : theirs) is_missing(in_common, array);
    std::vector<io::PointArray> left;
    for (const io::PointArray& array : common) {
      if (!is_missing(in_theirs, array)) left.push_back(array);
    }
    common = std::move(left);
  }
  const auto own = io::detail::by_kind(mesh.arrays);
  if (points > 0) {
    for (io::PointArray& array : common) array = *io::detail::find_alike(own, array);
  }
  mesh.arrays = std::move(common);
}

/// Adds what other ranks note of their pieces, once each. Collective.
void share_notices(const Ranks& ranks, std::vector<std::string>& notices) {
  constexpr char end = '\0';  // which no notice has
  std::string own;
  for (const std::string& notice : notices) own += notice + end;
  io::detail::DistinctTexts all;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    std::istringstream from(ranks.broadcast(own, rank));
    for (std::string notice; std::getline(from, notice, end);) all.add(notice);
  }
  notices = all.take();
}

/// Adds a coordinate in the type that points of all ranks have.
void add_height(io::Dataset& mesh, int axis, bool is_in_float) {
  outputs::add_height(mesh, axis);
  io::PointArray::Values& values = mesh.arrays.front().values;
  const auto* const floats = std::get_if<std::vector<float>>(&values);
  if (is_in_float || floats == nullptr) return;
  std::vector<double> doubles(floats->begin(), floats->end());
  values = std::move(doubles);
}

/// How many cells of each type all ranks have together. Collective.
std::array<Offset, 256> cells_of_all(const Ranks& ranks, const io::SomePieces& some) {
  std::array<Offset, 256> census{};
  for (const std::int64_t type : some.types) {
    if (type >= 0 && type < 256) ++census[static_cast<std::size_t>(type)];  // others are refused
  }
  ranks.sum(census.data(), static_cast<int>(census.size()));
  return census;
}

/// Calls use(cell) with the cell that each of this rank's simplices is of.
template <class Use>
void for_each_cell(const io::SomePieces& some, const Use& use) {
  const auto& arrays = some.mesh.cell_arrays;
  const std::vector<Id>* const cells = arrays.empty() ? nullptr : &std::get<std::vector<Id>>(arrays[0].values);
  for (std::size_t t = 0; t < some.mesh.cells(); ++t) use(cells == nullptr ? t : (*cells)[t]);
}

/// The global ids of the cells that this rank's simplices are of.
std::vector<std::int64_t> ids_of_simplices(const io::SomePieces& some) {
  std::vector<std::int64_t> ids;
  for_each_cell(some, [&](std::size_t cell) { ids.push_back(some.cell_ids[cell]); });
  return ids;
}

/// For each of this rank's simplices the place of its cell among those of all ranks, in the order of their ids, or of
/// ranks; none where all cells are simplices. Collective.
GlobalIds cells_on_ranks(const Ranks& ranks, const io::PieceNames& pieces, const io::SomePieces& some, Offset count) {
  if (ranks.least(std::int64_t(some.mesh.cell_arrays.empty())) == 1) return {};
  const GlobalId before = ranks.sum_before(count);
  GlobalIds places;
  if (!pieces.cell_ids.empty()) places = places_of(ranks, some.cell_ids, true);
  GlobalIds cells;
  detail::together(ranks, [&] {
    cells = allocate<GlobalIds>("GALE::cells_of_simplices", some.mesh.cells());
    Offset t = 0;
    for_each_cell(some, [&](std::size_t cell) {
      cells(t++) = places.extent(0) > 0 ? places(cell) : before + static_cast<GlobalId>(cell);
    });
  });
  return cells;
}

}  // namespace

SharedInput read_pieces(const Ranks& ranks, const InputOptions& input, const io::PieceNames& pieces) {
  SharedInput shared;
  io::SomePieces some;
  detail::together(ranks, [&] { some = io::read_pieces(input.input, share_of(pieces, ranks), input.read); });
  io::Dataset& mesh = some.mesh;
  const auto cells = static_cast<Offset>(some.types.size());
  const auto count = std::visit([](const auto& points) { return Offset(points.extent(0)); }, mesh.points);
  shared.is_in_float = ranks.least(std::int64_t(mesh.points.index() == 0)) == 1;
  GlobalIds ids, cell_ids;
  if (pieces.point_ids.empty()) {
    Array<detail::Point, HostMemory> points;
    detail::together(ranks, [&] {
      const auto copy = [&](const auto& all) {
        return detail::tabulated<detail::Point>("GALE::piece_points", count, [&](Offset i) {
          return detail::Point{all(i, 0), all(i, 1), all(i, 2)};
        });
      };
      points = std::visit(copy, mesh.points);
    });
    ids = merged_ids(ranks, points);
    mesh.notices.push_back("its points have no global ids: those of equal coordinates are one");
  } else {
    ids = places_of(ranks, some.point_ids, false);
  }
  const std::array<Offset, 256> census = cells_of_all(ranks, some);
  const int dimension = highest_dimension(census) == 2 ? 2 : 3;
  detail::together(ranks, [&] { io::split_pieces(input.input, some, ids, input.read, dimension); });
  const auto split = notices_of_split(census, ranks.sum(static_cast<std::int64_t>(mesh.cells())), dimension + 1);
  mesh.notices.insert(mesh.notices.begin(), split.begin(), split.end());
  shared.cells = cells_on_ranks(ranks, pieces, some, cells);
  if (!pieces.cell_ids.empty()) cell_ids = places_of(ranks, ids_of_simplices(some), true);
  if (input.height) detail::together(ranks, [&] { add_height(mesh, *input.height, shared.is_in_float); });
  keep_common(ranks, mesh, count);
  share_notices(ranks, mesh.notices);
  detail::together(ranks, [&] {
    const auto by_ids = [&](const auto& all) -> CellRows<GlobalId> {
      return detail::tabulated_rows<GlobalId, std::decay_t<decltype(all)>::static_extent(1)>(
          "GALE::input_cells", all.extent(0), [&](Offset t, int corner) { return ids(all(t, corner)); });
    };
    const CellRows<GlobalId> simplices = dimension == 3 ? by_ids(mesh.tetrahedra) : by_ids(mesh.triangles);
    std::visit(
        [&](const auto& points) {
          shared.part =
              pieces.cell_ids.empty() ? part_of(ids, points, simplices) : part_of(ids, points, simplices, cell_ids);
        },
        mesh.points);
    shared.field = select_field(mesh, input);
    shared.order = outputs::order_array(mesh, shared.field);
    shared.has_order = shared.order.name != shared.field.name;
    shared.has_ids =
        pieces.point_ids == io::global_point_ids && outputs::detail::find_array(mesh, io::global_point_ids) != nullptr;
  });
  shared.arrays = std::move(mesh.arrays);
  shared.notices = std::move(mesh.notices);
  shared.is_dealt_out = static_cast<int>(pieces.sources.size()) < ranks.size();
  return shared;
}

}  // namespace gale::app
