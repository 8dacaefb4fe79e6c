#include <gale/base/group_by.hpp>
#include <gale/base/parallel.hpp>
#include <gale/ttk/segments.hpp>

namespace gale::ttk {

Segments::Segments(const Segmentation& segmentation)
    : vertex_input_(segmentation.vertex_input.in<HostMemory>()),
      vertex_begin_(segmentation.vertex_begin.in<HostMemory>()) {
  const auto internal = allocate<Array<Id, HostMemory>>("GALE::ttk_vertex_internal", vertex_input_.extent(0));
  parallel_for("GALE::ttk_invert", HostExecutionSpace(), vertex_input_.extent(0),
               [&](Offset i) { internal(vertex_input_(i)) = static_cast<Id>(i); });
  vertex_internal_ = internal;
  find_segments();
}

Segments::Segments(const Mesh& mesh)
    : vertex_input_(mesh.vertex_input()), vertex_internal_(mesh.vertex_internal()), vertex_begin_(mesh.vertex_begin()) {
  find_segments();
  if (mesh.on_device()) return;
  encoded_ = mesh.encoded();
  cell_input_ = mesh.cell_input().data();
}

void Segments::find_segments() {
  segment_of_ = allocate<Array<Id, HostMemory>>("GALE::ttk_segments", vertex_input_.extent(0));
  parallel_for("GALE::ttk_segments", HostExecutionSpace(), count(), [&](Offset segment) {
    for (const Id v : vertices(static_cast<Id>(segment))) segment_of_(vertex_input_(v)) = static_cast<Id>(segment);
  });
}

void Segments::group(const Cells& cells) {
  if (cell_input_ != nullptr || grouped_.rows() > 0) return;
  const Id* const segment_of = segment_of_.data();
  grouped_ = group_by("GALE::ttk_cells", HostExecutionSpace(), cells.count(), count(), [=](Id cell, const auto& visit) {
    Id met[4];
    for (int corner = 0; corner < cells.corners(); ++corner) {
      const Id here = met[corner] = segment_of[cells.vertex(cell, corner)];
      bool fresh = true;
      for (int before = 0; before < corner; ++before) fresh = fresh && met[before] != here;
      if (fresh) visit(here);
    }
  });
}

void Segments::gather(Id segment, std::vector<Id>& cells) const {
  cells.clear();
  if (cell_input_ == nullptr) {
    const Span<Id> row = grouped_.row(segment);
    cells.assign(row.begin(), row.end());
    return;
  }
  for (Id t = encoded_.internal_begin(segment); t < encoded_.internal_begin(segment + 1); ++t) {
    cells.push_back(cell_input_[t]);
  }
  for (Offset i = encoded_.external_begin(segment); i < encoded_.external_begin(segment + 1); ++i) {
    cells.push_back(cell_input_[encoded_.external(i)]);
  }
}

}  // namespace gale::ttk
