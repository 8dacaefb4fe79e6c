#pragma once

#include <algorithm>
#include <vector>

#include <gale/mesh/exchange/global_index.hpp>

namespace gale::detail {

/// The cells that a rank keeps of its own part: their places in it, ascending, and their global ids.
struct KeptCells {
  Offset count = 0;
  Array<Id, HostMemory> places;           ///< empty where all are kept
  Array<const GlobalId, HostMemory> ids;  ///< the whole part's ids; empty where they are counted
  GlobalId first_id = 0;                  ///< the part's first one, where they are counted

  Offset place(Offset k) const { return places.extent(0) == 0 ? k : Offset(places(k)); }

  /// How many of those from k on, before `end`, follow one another in the part.
  Offset run(Offset k, Offset end) const {
    if (places.extent(0) == 0) return end - k;
    Offset next = k + 1;
    while (next < end && places(next) == places(next - 1) + 1) ++next;
    return next - k;
  }

  GlobalId id_at(Offset place) const { return ids.extent(0) == 0 ? first_id + place : ids(place); }
  GlobalId id(Offset k) const { return id_at(place(k)); }
};

/// Cells that follow one another among all that a rank holds, as they do in its part.
struct CellRun {
  Id begin;  ///< among all
  Id place;  ///< in the part
  Id count;
};

/// Where the cells that a rank holds come from, by ascending global ids: local input ids are places among them.
/// Cells that it keeps have that order mostly, and received ones are few: then it takes room for these alone.
class CellPlaces {
 public:
  CellPlaces() = default;

  /// Throws gale::Error for an id that occurs twice.
  CellPlaces(const KeptCells& kept, const GlobalIds& received);

  Offset count() const { return kept_.count + static_cast<Offset>(received_.extent(0)); }

  /// Whether their ids follow one another.
  bool are_counted() const {
    return kept_.ids.extent(0) == 0 && kept_.places.extent(0) == 0 && received_.extent(0) == 0;
  }

  /// Which of counted ones has a global id, or no_id.
  Id counted(GlobalId id) const {
    const GlobalId place = id - kept_.first_id;
    return place >= 0 && place < kept_.count ? static_cast<Id>(place) : no_id;
  }

  /// Whether cells that are kept follow one another as in the part.
  bool keep_order() const { return sources_.extent(0) == 0; }

  /// The runs of those that are kept, ascending, and received(i, r) for all others, on all threads. For places that
  /// keep the order.
  std::vector<CellRun> runs() const;
  template <class Received>
  void visit_received(const Received& received) const {
    parallel_for("GALE::received_cells", HostExecutionSpace(), received_at_.extent(0),
                 [&](Offset r) { received(Offset(received_at_(r)), received_by_id(r)); });
  }

  /// The global id of the i-th, and those of all.
  GlobalId id(Offset i) const;
  GlobalIds ids() const;

  /// Where those among first..last-1 come from, in order: calls kept(i, place, count) for some, i to i + count - 1,
  /// that follow one another in the part, and received(i, r) for others.
  template <class Kept, class Received>
  void visit(Offset first, Offset last, const Kept& kept, const Received& received) const {
    if (sources_.extent(0) != 0) {
      for (Offset i = first; i < last; ++i)
        sources_(i) < kept_.count ? kept(i, kept_.place(sources_(i)), Offset(1))
                                  : received(i, sources_(i) - kept_.count);
      return;
    }
    Offset before = received_before(first);
    for (Offset i = first; i < last;) {
      const Offset end =
          before == static_cast<Offset>(received_at_.extent(0)) ? last : std::min<Offset>(received_at_(before), last);
      if (i < end) {
        const Offset run = kept_.run(i - before, end - before);
        kept(i, kept_.place(i - before), run);
        i += run;
      } else {
        received(i++, received_by_id(before++));
      }
    }
  }

 private:
  void merge();
  void sort();

  /// How many of those that were received come before the i-th of all.
  Offset received_before(Offset i) const {
    const Id* const begin = received_at_.data();
    return std::lower_bound(begin, begin + received_at_.extent(0), i) - begin;
  }

  Offset received_by_id(Offset r) const { return received_by_id_.extent(0) == 0 ? r : Offset(received_by_id_(r)); }

  KeptCells kept_;
  GlobalIds received_;                    ///< in the order in which they came
  Array<Id, HostMemory> received_by_id_;  ///< empty where they came in that order
  Array<Id, HostMemory> received_at_;     ///< their places among all, ascending

  // Where ids of those that are kept don't ascend.
  Array<Id, HostMemory> sources_;  ///< the i-th of all among the kept ones, then the received ones
  GlobalIds sorted_;
};

}  // namespace gale::detail
