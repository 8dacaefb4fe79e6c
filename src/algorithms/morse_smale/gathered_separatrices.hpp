#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include <gale/algorithms/separatrices.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/threads.hpp>

// Separatrices that several threads find, each with a tracer of its own.

namespace gale::detail {

/// Calls follow(tracer, place) for each of `simplices` on so many threads, each of which has a tracer made by
/// make(thread). They come in the order of their highest vertices: GALE numbers vertices along a curve, so neighbours
/// in this order are close to each other, and what a thread reads for one is still in its caches for the next.
template <class Make, class Simplex, class Follow>
auto traced(const std::vector<Simplex>& simplices, int threads, const Make& make, const Follow& follow) {
  std::vector<Id> order(simplices.size());
  std::iota(order.begin(), order.end(), Id(0));
  parallel_sort("GALE::sort_traced", order.begin(), order.end(),
                [&](Id i, Id j) { return simplices[i] < simplices[j]; });
  std::vector<decltype(make(0))> tracers(threads);
  in_turns(threads, static_cast<std::int64_t>(order.size()), [&](int thread, std::int64_t i) {
    auto& tracer = tracers[thread];
    if (!tracer) tracer = make(thread);
    follow(*tracer, order[i]);
  });
  return tracers;
}

/// Brings the separatrices that tracers `found` into the order of their `ends`, which are their sources or their
/// destinations: places below `count`. One thread found all those with the same end, one after the other: they stay in
/// their order.
template <class Tracer, class Cell>
Separatrices<Cell> gathered(const std::vector<std::unique_ptr<Tracer>>& tracers, Separatrices<Cell> Tracer::*found,
                            std::vector<Id> Separatrices<Cell>::*ends, Id count) {
  std::vector<Separatrices<Cell>> parts;
  for (const auto& tracer : tracers) {
    if (tracer) parts.push_back(std::move((*tracer).*found));
  }
  struct Group {
    int part = 0;
    Id first = 0, size = 0;
  };
  std::vector<Group> groups(count);
  for (int part = 0; part < static_cast<int>(parts.size()); ++part) {
    for (Id i = 0; i < parts[part].count(); ++i) {
      Group& group = groups[(parts[part].*ends)[i]];
      if (group.size++ == 0) group = {part, i, 1};
    }
  }
  std::vector<Id> place(count + 1, 0);
  std::vector<Offset> cell(count + 1, 0);
  for (Id g = 0; g < count; ++g) {
    const auto& [part, first, size] = groups[g];
    place[g + 1] = place[g] + size;
    cell[g + 1] = cell[g] + (size == 0 ? 0 : parts[part].begin[first + size] - parts[part].begin[first]);
  }
  Separatrices<Cell> all;
  const auto copy = [&](auto member) {
    auto& to = all.*member;
    if (std::all_of(parts.begin(), parts.end(), [&](const auto& part) { return (part.*member).empty(); })) return;
    to.resize(place[count]);
    parallel_for("GALE::gather_separatrices", HostExecutionSpace(), count, [&](Offset g) {
      const Group& group = groups[g];
      if (group.size > 0) std::copy_n(&(parts[group.part].*member)[group.first], group.size, &to[place[g]]);
    });
  };
  copy(&Separatrices<Cell>::sources);
  copy(&Separatrices<Cell>::destinations);
  copy(&Separatrices<Cell>::is_only);
  copy(&Separatrices<Cell>::joins);
  all.begin.resize(place[count] + 1);
  all.cells = zeros<Cell>(cell[count]);
  parallel_for("GALE::gather_cells", HostExecutionSpace(), count, [&](Offset g) {
    const auto& [part, first, size] = groups[g];
    if (size == 0) return;
    const auto& from = parts[part];
    for (Id i = 0; i < size; ++i) all.begin[place[g] + i + 1] = cell[g] + from.begin[first + i + 1] - from.begin[first];
    std::copy(from.first(first), from.last(first + size - 1), all.cells.data() + cell[g]);
  });
  return all;
}

}  // namespace gale::detail
