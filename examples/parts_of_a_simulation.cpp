// Heat that spreads through a block of tetrahedra which lies on several MPI ranks: each has a slab of it, computes the
// temperatures there in time, and has its extrema found where they are, without files: mpirun -n 4
// parts_of_a_simulation

#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/distributed/distributed_mesh.hpp>
#include <gale/io/synthetic.hpp>

namespace {

constexpr int n = 32;  // points along each axis
constexpr int layer = n * n;

/// Temperatures at the points of a slab of layers, by explicit steps of the heat equation; nothing passes the block's
/// surface. The first and the last layer are the neighbours', too, who compute them as well.
class Heat {
 public:
  Heat(MPI_Comm comm, std::int64_t first_point, std::size_t points)
      : comm_(comm), layers_(static_cast<int>(points) / layer) {
    int rank = 0, ranks = 0;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &ranks);
    below_ = rank == 0 ? MPI_PROC_NULL : rank - 1;
    above_ = rank + 1 == ranks ? MPI_PROC_NULL : rank + 1;
    now_.resize(points + 2 * layer);  // and a layer of the neighbours' on either side
    for (std::size_t i = 0; i < points; ++i)
      now_[layer + i] = spark(static_cast<std::uint32_t>(first_point + std::int64_t(i)));
    next_ = now_;
  }

  void step() {
    MPI_Sendrecv(at(1), layer, MPI_FLOAT, below_, 0, at(layers_), layer, MPI_FLOAT, above_, 0, comm_,
                 MPI_STATUS_IGNORE);
    MPI_Sendrecv(at(layers_ - 2), layer, MPI_FLOAT, above_, 1, at(-1), layer, MPI_FLOAT, below_, 1, comm_,
                 MPI_STATUS_IGNORE);
    for (int z = 0; z < layers_; ++z) {
      const bool is_bottom = z == 0 && below_ == MPI_PROC_NULL, is_top = z + 1 == layers_ && above_ == MPI_PROC_NULL;
      for (int i = 0; i < layer; ++i) {
        const float* const here = at(z) + i;
        const int x = i % n, y = i / n;
        float flow = 0;
        const auto add = [&](bool is_there, int offset) { flow += is_there ? here[offset] - *here : 0.0f; };
        add(x > 0, -1);
        add(x + 1 < n, 1);
        add(y > 0, -n);
        add(y + 1 < n, n);
        add(!is_bottom, -layer);
        add(!is_top, layer);
        next_[(z + 1) * layer + i] = *here + 0.125f * flow;
      }
    }
    std::swap(now_, next_);
  }

  /// A value for each point of the slab.
  Kokkos::View<const float*, gale::HostMemory> values() const {
    return Kokkos::View<const float*, gale::HostMemory>(now_.data() + layer, now_.size() - 2 * layer);
  }

 private:
  float* at(int z) { return now_.data() + (z + 1) * layer; }

  /// Temperatures to begin with, by no order.
  static float spark(std::uint32_t point) {
    point = (point ^ point >> 16) * 0x7feb352d;
    point = (point ^ point >> 15) * 0x846ca68b;
    return static_cast<float>((point ^ point >> 16) >> 8);
  }

  MPI_Comm comm_;
  int layers_, below_ = 0, above_ = 0;
  std::vector<float> now_, next_;
};

/// Views of what this rank has: any part of a mesh will do. Global ids here are places in the whole block.
gale::DistributedMesh distribute(const gale::Communicator& ranks, const gale::io::GridPart& part) {
  const Kokkos::View<gale::GlobalId*, gale::HostMemory> ids("ids", part.field.size()),
      cell_ids("cell_ids", part.tetrahedra.extent(0));
  for (std::size_t i = 0; i < ids.extent(0); ++i) ids(i) = part.first_vertex + gale::GlobalId(i);
  for (std::size_t t = 0; t < cell_ids.extent(0); ++t) cell_ids(t) = part.first_tetrahedron + gale::GlobalId(t);
  return gale::DistributedMesh(ranks, gale::make_part(ids, part.points, part.tetrahedra, cell_ids));
}

bool run() {
  const gale::Communicator ranks(MPI_COMM_WORLD);
  if (ranks.size() >= n) return false;  // a layer of cubes each
  const gale::io::GridPart part = gale::io::make_grid_part(n, ranks.rank(), ranks.size());
  const gale::DistributedMesh mesh = distribute(ranks, part);  // once: it stays
  Heat heat(MPI_COMM_WORLD, part.first_vertex, part.field.size());
  long long maxima = n * layer;
  for (int step = 0; step <= 40; ++step) {
    if (step % 10 == 0) {
      const gale::VertexOrder order(mesh, heat.values());
      const auto points = gale::find_critical_points(order);
      const auto gradient = gale::find_discrete_gradient(order);
      if (points.counts[3] >= maxima) return false;  // heat evens out
      maxima = points.counts[3];
      if (ranks.rank() == 0) {
        std::printf("step %d on %d ranks: %lld minima, %lld maxima; Euler characteristic %lld\n", step, ranks.size(),
                    static_cast<long long>(points.counts[0]), maxima, static_cast<long long>(gradient.euler()));
      }
      if (gradient.euler() != 1) return false;
    }
    heat.step();
  }
  return maxima > 0;
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  bool is_right = false;
  {
    const Kokkos::ScopeGuard kokkos(argc, argv);
    is_right = run();
  }
  MPI_Finalize();
  return is_right ? 0 : 1;
}
