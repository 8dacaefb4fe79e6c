#include <utility>

#include <gale/algorithms/excerpt/edge_fall.hpp>
#include <gale/algorithms/gradient/edges_on_host.hpp>
#include <gale/base/error.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

EdgeFall::EdgeFall(const DiscreteGradient& gradient, bool expects_all)
    : gradient_(gradient), expects_all_(expects_all), is_on_host_(!gradient.store().is_from_kernels()) {}

/// Falls on the host from the beginning if the device is full.
std::vector<std::array<Id, 2>> EdgeFall::fall(std::vector<std::array<Id, 2>> edges) {
  if (is_on_host_) return fall_on_host(std::move(edges));
  starts_.insert(starts_.end(), edges.begin(), edges.end());
  try {
    if (!by_kernels_) by_kernels_ = std::make_unique<FallingEdges>(gradient_, expects_all_);
    return by_kernels_->fall(edges);
  } catch (const OutOfMemory&) {
    by_kernels_.reset();
    is_on_host_ = true;
    return fall_on_host(std::move(starts_));
  }
}

/// Falls again on the host if the device is full.
std::vector<std::array<Id, 3>> EdgeFall::passed() {
  if (by_kernels_) {
    try {
      auto passed = by_kernels_->passed();
      by_kernels_.reset();
      return passed;
    } catch (const OutOfMemory&) {
      by_kernels_.reset();
      fall_on_host(std::move(starts_));
    }
  }
  return std::move(passed_);
}

/// Has a thread go on from one edge for some steps, and leave what is open then to whoever comes next.
std::vector<std::array<Id, 2>> EdgeFall::fall_on_host(std::vector<std::array<Id, 2>> open) {
  constexpr int most_steps = 1024;
  struct Part {
    std::vector<std::array<Id, 3>> passed;
    std::vector<std::array<Id, 2>> open, left, elsewhere;
  };
  const EdgesOnHost edges(gradient_);
  const Interval owned = gradient_.mesh().owned_vertices();
  std::vector<Part> parts(host_threads());
  const auto come_to = [&](Part& part, const std::array<Id, 2>& edge) {
    if (known_.insert(pair_key(edge[0], edge[1]))) (owned.has(edge[0]) ? part.open : part.elsewhere).push_back(edge);
  };
  for (bool are_known = false; !open.empty(); are_known = true) {
    in_turns(host_threads(), static_cast<std::int64_t>(open.size()), [&](int thread, std::int64_t first) {
      Part& part = parts[thread];
      part.open.clear();
      if (are_known) {
        part.open.push_back(open[first]);
      } else {
        come_to(part, open[first]);
      }
      for (int step = 0; step < most_steps && !part.open.empty(); ++step) {
        const auto [high, low] = part.open.back();
        part.open.pop_back();
        const Id third = edges.third(high, low);
        if (third == edge_has_vertex) continue;
        part.passed.push_back({high, low, third});
        if (third < 0) continue;
        come_to(part, edges.ordered(high, third));
        come_to(part, edges.ordered(low, third));
      }
      part.left.insert(part.left.end(), part.open.begin(), part.open.end());
    });
    open.clear();
    for (Part& part : parts) {
      open.insert(open.end(), part.left.begin(), part.left.end());
      part.left.clear();
    }
    stop_if_asked();
  }
  std::vector<std::array<Id, 2>> elsewhere;
  for (const Part& part : parts) {
    passed_.insert(passed_.end(), part.passed.begin(), part.passed.end());
    elsewhere.insert(elsewhere.end(), part.elsewhere.begin(), part.elsewhere.end());
  }
  return elsewhere;
}

}  // namespace gale::detail
