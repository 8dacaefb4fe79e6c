#include <gale/relations/host_producer.hpp>

#include <vector>

#include <gale/relations/detail/host_workspace.hpp>

namespace gale {

struct HostProducer::Workspace {
  Mesh mesh;
  std::vector<Relation> wanted;
  detail::HostWorkspace star;
  std::unique_ptr<Id[]> words;
  std::vector<Offset> directory;
  Offset used = 0;
  BlockPool pool;

  Workspace(const Mesh& given, RelationSet relations)
      : mesh(given), wanted(members_of(relations)), star(mesh, relations), directory(wanted.size()) {
    pool.used = &used;
    pool.directory = directory.data();
    grow(Offset(1) << 14);
  }

  void grow(Offset count) {
    pool.capacity = count + count / 2;
    words.reset(new Id[pool.capacity]);
    pool.words = words.get();
  }
};

HostProducer::HostProducer(const Mesh& mesh, RelationSet wanted) : workspace_(new Workspace(mesh, wanted)) {}
HostProducer::~HostProducer() = default;
HostProducer::HostProducer(HostProducer&&) noexcept = default;
HostProducer& HostProducer::operator=(HostProducer&&) noexcept = default;

SegmentRows HostProducer::compute(Id segment) {
  auto& work = *workspace_;
  for (work.used = 0; !work.star.compute(segment, work.pool); work.used = 0) work.grow(work.used);
  SegmentRows rows(segment, work.mesh.vertex_begin()(segment), work.mesh.vertex_begin()(segment + 1));
  const Offset* entry = work.directory.data();
  for (const Relation relation : work.wanted) rows.set(relation, work.pool.words + *entry++);
  return rows;
}

}  // namespace gale
