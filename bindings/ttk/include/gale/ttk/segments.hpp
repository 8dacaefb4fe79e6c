#pragma once

#include <vector>

#include <gale/base/csr.hpp>
#include <gale/export.hpp>
#include <gale/mesh/intervals.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/ttk/cells.hpp>

namespace gale::ttk {

/// The segments' vertices, in the caller's ids and in GALE's, and the caller's cells that touch a segment.
class GALE_EXPORT Segments {
 public:
  Segments() = default;

  /// Takes the segments of a mesh that isn't encoded yet. O(n), on all our threads.
  explicit Segments(const Segmentation& segmentation);

  /// Takes those of an encoded mesh, which knows what touches a segment, too, where it isn't on a device.
  explicit Segments(const Mesh& mesh);

  Id count() const { return static_cast<Id>(vertex_begin_.extent(0)) - 1; }
  const Id* vertex_input() const { return vertex_input_.data(); }
  const Id* vertex_internal() const { return vertex_internal_.data(); }

  /// The vertices of a segment, in GALE's ids.
  Interval vertices(Id segment) const { return {vertex_begin_.data()[segment], vertex_begin_.data()[segment + 1]}; }

  /// The segment of a vertex (the caller's id).
  Id of(Id vertex) const { return segment_of_.data()[vertex]; }

  /// Groups cells by the segments that they touch, unless what touches a segment is known. These must be valid. O(n),
  /// on all our threads; 4 bytes for each segment that a cell touches.
  void group(const Cells& cells);

  /// Replaces `cells` by those that touch a segment, in no order. To be grouped before, where there is no mesh.
  void gather(Id segment, std::vector<Id>& cells) const;

  std::size_t bytes() const { return sizeof(Id) * (segment_of_.span() + grouped_.entries.span()); }

 private:
  void find_segments();

  Array<const Id, HostMemory> vertex_input_, vertex_internal_, vertex_begin_;
  Array<Id, HostMemory> segment_of_;
  Csr<Id, HostMemory> grouped_;  ///< segment -> its cells
  EncodedMesh<HostMemory> encoded_;
  const Id* cell_input_ = nullptr;  ///< where there is a mesh
};

}  // namespace gale::ttk
