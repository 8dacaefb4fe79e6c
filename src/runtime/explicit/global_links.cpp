#include <algorithm>

#include <gale/base/parallel.hpp>
#include <gale/runtime/explicit/global_links.hpp>

namespace gale::detail {

namespace {

Id longest_row(const Rows& rows, Id count) {
  return -reduce_min("GALE::longest_row", HostExecutionSpace(), count, Id(0),
                     [&](Offset v) { return -rows[static_cast<Id>(v)].size(); });
}

template <class Place>
void look_up(const EncodedMesh<HostMemory>& mesh, const Rows& vt, const Rows& vv, Id vertices, Place* places) {
  parallel_for("GALE::link", HostExecutionSpace(), vertices, [&](Offset i) {
    const Id v = static_cast<Id>(i);
    const Row neighbours = vv[v];
    Place* to = places + Offset(3) * vt.offsets[v];
    for (const Id t : vt[v]) {
      for (int corner = 0; corner < 4; ++corner) {
        const Id other = mesh.tetrahedra(t, corner);
        if (other == v) continue;
        *to++ = static_cast<Place>(std::lower_bound(neighbours.begin(), neighbours.end(), other) - neighbours.begin());
      }
    }
  });
}

}  // namespace

GlobalLinks global_links(const Mesh& mesh, const GlobalRows& vt_rows, const GlobalRows& vv_rows) {
  const Rows vt = vt_rows.rows(), vv = vv_rows.rows();
  GlobalLinks links;
  links.width = width_for(longest_row(vv, mesh.vertices()));
  const Offset entries = vt_rows.ids.extent(0);
  links.places = allocate<Array<std::uint8_t, HostMemory>>("GALE::link", 3 * entries * links.width);
  void* const places = links.places.data();
  if (links.width == 1) look_up(mesh.encoded(), vt, vv, mesh.vertices(), static_cast<std::uint8_t*>(places));
  if (links.width == 2) look_up(mesh.encoded(), vt, vv, mesh.vertices(), static_cast<std::uint16_t*>(places));
  if (links.width == 4) look_up(mesh.encoded(), vt, vv, mesh.vertices(), static_cast<Id*>(places));
  return links;
}

}  // namespace gale::detail
