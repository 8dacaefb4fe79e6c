#pragma once

#include <array>
#include <functional>
#include <memory>

#include <gale/base/threads.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale {

/// How one thread reads rows in any order. Made by a `Structure`, which must outlive it; used by one thread at a time.
///
/// A row stays valid until this consumer asks for its next row of the same relation.
class Consumer {
 public:
  virtual ~Consumer() = default;

  /// The row of a simplex (GALE's id) in any relation but link. A few ns inside the segment that was asked for last;
  /// else what it takes to have the block computed, or, in a face relation, to look it up (`face_row` does that without
  /// a call). Throws gale::Error if the relation was not preconditioned, if there is no such simplex, or if it can't be
  /// computed.
  Row row(Relation relation, Id simplex) {
    auto& rows = current_[static_cast<int>(relation)];
    if (!rows.has(row_dimension(relation), simplex)) reload(rows, relation, simplex);
    return rows[relation][simplex];
  }

  /// The link of a vertex; likewise.
  LinkRow link(Id vertex) {
    auto& rows = current_[static_cast<int>(Relation::link)];
    if (!rows.has(0, vertex)) reload(rows, Relation::link, vertex);
    return rows.links()[vertex];
  }

 protected:
  /// Rows of a relation, that of `simplex` among them, valid until the next call for the same relation.
  virtual SegmentRows load(Relation relation, Id simplex) = 0;

 private:
  /// Forgets the old rows first: loading ends their validity, also if it throws.
  void reload(SegmentRows& rows, Relation relation, Id simplex) {
    rows = SegmentRows();
    rows = load(relation, simplex);
  }

  std::array<SegmentRows, relation_count> current_;
};

/// How to go through a mesh segment by segment.
struct SweepOptions {
  int threads = host_threads();  ///< consumers; at least 1

  /// Told now and then, by one of the consumers, how many segments are done.
  std::function<void(Id done, Id segments)> progress;
};

/// Whatever answers which simplices touch which: all rows at once (`ExplicitStructure`), or segment by segment as they
/// are wanted
/// (`Runtime`). Algorithms are written against this and give the same results on each.
class Structure {
 public:
  /// Called with a consumer's number, in 0..threads-1, and the blocks of a segment, which are valid during the call.
  /// Different consumers call it at the same time.
  using SegmentBody = std::function<void(int consumer, const SegmentRows& rows)>;

  virtual ~Structure() = default;

  virtual const Mesh& mesh() const = 0;

  /// The relations that it was preconditioned for.
  virtual RelationSet relations() const = 0;

  /// Has it every row of these at any time? Then a consumer reads each in a few ns. Else rows of face relations come
  /// from the mesh' tables, and `face_row` is the fast way to them.
  virtual bool keeps_all_rows() const { return false; }

  /// A sweep: calls `body` once for every segment, in no order to rely on, with the blocks of the relations `wanted`,
  /// on `options.threads` consumer threads. If a body throws, no further segment is begun and the exception is thrown
  /// again here. Throws gale::Error if `wanted` has a relation that was not preconditioned.
  virtual void for_each_segment(RelationSet wanted, const SweepOptions& options, const SegmentBody& body) = 0;

  /// For rows in any order. Any thread may make one, and any number of them.
  virtual std::unique_ptr<Consumer> consumer() = 0;
};

}  // namespace gale
