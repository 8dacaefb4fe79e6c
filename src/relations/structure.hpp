#pragma once

#include <array>
#include <functional>
#include <memory>

#include <gale/base/threads.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale {

/// How one thread reads rows in any order. Made by a `Structure`, which must outlive it; used by one thread at a time.
///
/// A row stays valid until this consumer asks for its next row of the same relation.
class Consumer {
 public:
  virtual ~Consumer() = default;

  /// The row of a simplex (GALE's id) in VV or VT. A few ns inside the segment that was asked for last; else what it takes to have
  /// the block computed. Throws gale::Error if the relation was not preconditioned, or if it can't be computed.
  Row row(Relation relation, Id vertex) {
    auto& rows = current_[static_cast<int>(relation)];
    if (!rows.has(vertex)) reload(rows, relation, vertex);
    return rows[relation][vertex];
  }

  /// The link of a vertex; likewise.
  LinkRow link(Id vertex) {
    auto& rows = current_[static_cast<int>(Relation::link)];
    if (!rows.has(vertex)) reload(rows, Relation::link, vertex);
    return rows.links()[vertex];
  }

 protected:
  /// The block of a relation that holds the row of `vertex`, valid until the next call for the same relation.
  virtual SegmentRows load(Relation relation, Id vertex) = 0;

 private:
  /// Forgets the old rows first: loading ends their validity, also if it throws.
  void reload(SegmentRows& rows, Relation relation, Id vertex) {
    rows = SegmentRows();
    rows = load(relation, vertex);
  }

  std::array<SegmentRows, relation_count> current_;
};

/// How to go through a mesh segment by segment.
struct SweepOptions {
  int threads = host_threads();  ///< consumers; at least 1

  /// Told now and then, by one of the consumers, how many segments are done.
  std::function<void(Id done, Id segments)> progress;
};

/// Whatever answers which simplices touch which: all rows at once (`ExplicitStructure`), or segment by segment as they are wanted
/// (`Runtime`). Algorithms are written against this and give the same results on each.
class Structure {
 public:
  /// Called with a consumer's number, in 0..threads-1, and the blocks of a segment, which are valid during the call. Different consumers call it
  /// at the same time.
  using SegmentBody = std::function<void(int consumer, const SegmentRows& rows)>;

  virtual ~Structure() = default;

  virtual const Mesh& mesh() const = 0;

  /// The relations that it was preconditioned for.
  virtual RelationSet relations() const = 0;

  /// A sweep: calls `body` once for every segment, with the blocks of the relations `wanted`, on `options.threads` consumer threads.
  /// If a body throws, no further segment is begun and the exception is thrown again here. Throws gale::Error if `wanted` has a
  /// relation that was not preconditioned.
  virtual void for_each_segment(RelationSet wanted, const SweepOptions& options, const SegmentBody& body) = 0;

  virtual std::unique_ptr<Consumer> consumer() = 0;
};

/// Throws gale::Error, naming the relations and what to do, unless those that a structure was preconditioned for contain `wanted`.
void require_preconditioned(RelationSet preconditioned, RelationSet wanted);

/// Throws gale::Error unless `vertex` is one of the mesh'.
void require_vertex(const Mesh& mesh, Id vertex);

}  // namespace gale
