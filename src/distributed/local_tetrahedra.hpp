#pragma once

#include <array>
#include <vector>

#include <gale/distributed/distributed_mesh.hpp>
#include <gale/distributed/vertex_directory.hpp>

namespace gale::detail {

/// A tetrahedron on its way to another rank.
struct SentTetrahedron {
  GlobalId id;
  GlobalId vertices[4];
};

/// The tetrahedra that touch a vertex which this rank owns: those of its own part where they are, and those that it
/// got.
template <class Index>
class LocalTetrahedra {
 public:
  /// Sends each tetrahedron to the ranks that own a vertex of it. `own`: ids that this rank owns, as many as are known
  /// without a search: tetrahedra of these alone concern no other rank. Collective. Throws gale::Error as
  /// DistributedMesh says. Refers to `part`.
  LocalTetrahedra(const Communicator& ranks, const MeshPart<Index>& part, const VertexDirectory& directory,
                  const IdInterval& own, Offset most_local);

  /// Their global ids, ascending.
  const GlobalIds& ids() const { return ids_; }
  Offset count() const { return ids_.extent(0); }

  /// Calls visit(i, vertex_of) for the i-th of all, in no order, on all host threads: vertex_of(corner) is a global id.
  template <class Visit>
  void for_each(const char* label, const Visit& visit) const {
    const auto visit_kept = [&](Offset i, Offset k) {
      visit(i, [&](int corner) { return GlobalId(part_.tetrahedra(kept(k), corner)); });
    };
    if (places_.extent(0) != 0) {
      parallel_for(label, HostSpace(), count(), [&](Offset i) {
        if (places_(i) < kept_count_) {
          visit_kept(i, places_(i));
        } else {
          visit_received(i, places_(i) - kept_count_, visit);
        }
      });
      return;
    }
    for_each_kept(label, visit_kept);
    parallel_for(label, HostSpace(), received_.count(),
                 [&](Offset r) { visit_received(received_places_[r], r, visit); });
  }

  /// The vertices that they have and that this rank doesn't own, ascending: neither in `own` nor in `owned`.
  GlobalIds vertices_beside(const GlobalIds& owned) const;

 private:
  void choose(const Communicator& ranks, const VertexDirectory& directory, const std::vector<Id>& outer,
              GlobalId first_id, Dealt<SentTetrahedron>& sent);
  void keep_all_but(const std::vector<Id>& dropped);
  void sort(GlobalId first_id);
  void merge(GlobalId first_id);

  Offset kept(Offset k) const { return kept_.extent(0) == 0 ? k : Offset(kept_(k)); }
  GlobalId kept_id(Offset k, GlobalId first_id) const {
    return part_.tetrahedron_ids.extent(0) == 0 ? first_id + kept(k) : part_.tetrahedron_ids(kept(k));
  }

  template <class Visit>
  void visit_received(Offset i, Offset r, const Visit& visit) const {
    visit(i, [&](int corner) { return received_.entries(r).vertices[corner]; });
  }

  /// Calls visit(i, k) for the k-th one that was kept, which is the i-th of all; where all are merged.
  template <class Visit>
  void for_each_kept(const char* label, const Visit& visit) const {
    for_parts(label, kept_count_, threads_for(kept_count_), [&](int, Offset first, Offset last) {
      auto next = std::upper_bound(before_received_.begin(), before_received_.end(), first);
      for (Offset k = first; k < last; ++k) {
        while (next != before_received_.end() && *next <= k) ++next;
        visit(k + (next - before_received_.begin()), k);
      }
    });
  }

  const MeshPart<Index>& part_;
  const IdInterval own_;
  std::vector<Id> outer_;       ///< those of the part that are kept and have vertices outside `own`
  Array<Id, HostMemory> kept_;  ///< places in the part, ascending; empty where all are kept
  Offset kept_count_ = 0;
  Dealt<SentTetrahedron> received_;
  GlobalIds ids_;

  // Where ids of those that are kept ascend: how many of these come before each received one in the order of ids, which
  // ascends; and the places of received ones among all, as they were received.
  std::vector<Offset> before_received_, received_places_;

  Array<Id, HostMemory> places_;  ///< else: the i-th of all among the kept ones, then the received ones
};

/// Throws gale::Error on all ranks if one would hold more than `most` of what `name` says, e.g. "tetrahedra": it says
/// how many ranks it takes. Collective.
void require_local(const Communicator& ranks, const char* name, Offset count, Offset most);

}  // namespace gale::detail
