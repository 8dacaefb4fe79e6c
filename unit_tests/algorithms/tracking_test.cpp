#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include <gale/algorithms/simplify.hpp>
#include <gale/algorithms/tracking.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/mesh/make_mesh.hpp>

#include "algorithms/complexes.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

using Values = std::vector<double>;

DiscreteGradient gradient_of(const Mesh& mesh, const Values& field) {
  return find_discrete_gradient(VertexOrder(mesh, field.data(), field.size()));
}

Tracks track(const Mesh& mesh, const std::vector<Values>& steps, double threshold) {
  ExtremumTracker tracker;
  for (std::size_t t = 0; t < steps.size(); ++t)
    tracker.add(
        0.5 * t, gradient_of(mesh, steps[t]), [&steps, t](Id v) { return steps[t][v]; }, threshold);
  return tracker.tracks();
}

/// What becomes of an extremum: its vertex in the next step or, where it ends, that of the one that it merges with.
struct Fate {
  TrackEnd end;  ///< last_step: it goes on
  Id vertex;     ///< no_id: none
  bool operator==(const Fate& other) const { return end == other.end && vertex == other.vertex; }
};

/// The fate of each extremum of a kind, by step and vertex.
using Fates = std::map<std::pair<Id, Id>, Fate>;

Fates fates_of(const Tracks& tracks, bool maxima) {
  Fates fates;
  for (const Track& track : tracks.tracks) {
    for (std::size_t i = 0; i < track.extrema.size(); ++i) {
      const TrackedExtremum& one = tracks.extrema[track.extrema[i]];
      if (one.is_maximum != maxima) continue;
      const bool ends = i + 1 == track.extrema.size();
      const Id next = ends ? track.end_at : track.extrema[i + 1];
      fates[{one.step, one.vertex}] = {ends ? track.end : TrackEnd::last_step,
                                       next == no_id ? no_id : tracks.extrema[next].vertex};
    }
  }
  return fates;
}

/// The minima of a step, by nothing but edges: a vertex falls to its lowest neighbour, and minima that are joined below
/// the threshold are one.
struct BruteStep {
  const Values& field;
  std::vector<Id> minimum_of;        ///< for each vertex that of its manifold
  std::map<Id, double> persistence;  ///< of each minimum that is left

  BruteStep(const InputMesh& mesh, const Values& values, double threshold) : field(values), minimum_of(values.size()) {
    std::set<std::pair<Id, Id>> edges;
    for (const auto& corners : mesh.tetrahedra) {
      for (const Id a : corners) {
        for (const Id b : corners) {
          if (is_below(b, a)) edges.insert({a, b});
        }
      }
    }
    std::vector<Id> by_rank(values.size()), low(values.size());
    std::iota(by_rank.begin(), by_rank.end(), 0);
    std::iota(low.begin(), low.end(), 0);
    std::sort(by_rank.begin(), by_rank.end(), [&](Id a, Id b) { return is_below(a, b); });
    for (const auto& [a, b] : edges) {
      if (is_below(b, low[a])) low[a] = b;
    }
    for (const Id v : by_rank) minimum_of[v] = low[v] == v ? v : minimum_of[low[v]];
    std::map<Id, Id> older, joined;
    for (const Id v : minimum_of) older[v] = joined[v] = v;
    const auto root = [](std::map<Id, Id>& parents, Id v) {
      while (parents[v] != v) v = parents[v];
      return v;
    };
    std::vector<std::pair<Id, Id>> rising(edges.begin(), edges.end());
    std::sort(rising.begin(), rising.end(), [&](const auto& a, const auto& b) {
      return a.first != b.first ? is_below(a.first, b.first) : is_below(a.second, b.second);
    });
    for (const Id v : minimum_of) persistence[v] = values[by_rank.back()] - values[v];
    std::set<Id> gone;
    for (const auto& [a, b] : rising) {
      Id one = root(older, minimum_of[a]), other = root(older, minimum_of[b]);
      if (one == other) continue;
      if (is_below(one, other)) std::swap(one, other);
      older[one] = other;
      persistence[one] = values[a] - values[one];
      if (persistence[one] >= threshold && persistence[one] > 0) continue;
      joined[root(joined, minimum_of[a])] = root(joined, minimum_of[b]);
      gone.insert(one);
    }
    std::map<Id, Id> left;
    for (const auto& [v, parent] : older) {
      if (gone.count(v) == 0) left[root(joined, v)] = v;
    }
    for (const Id v : gone) persistence.erase(v);
    for (Id& minimum : minimum_of) minimum = left.at(root(joined, minimum));
  }

  bool is_below(Id a, Id b) const { return std::pair(field[a], a) < std::pair(field[b], b); }
};

Fates brute_fates(const InputMesh& mesh, const std::vector<Values>& fields, double threshold) {
  std::vector<BruteStep> steps;
  for (const Values& field : fields) steps.emplace_back(mesh, field, threshold);
  Fates fates;
  for (std::size_t t = 0; t < steps.size(); ++t) {
    for (const auto& [vertex, persistence] : steps[t].persistence) {
      Fate& fate = fates[{static_cast<Id>(t), vertex}] = {TrackEnd::last_step, no_id};
      if (t + 1 == steps.size()) continue;
      const Id next = steps[t + 1].minimum_of[vertex];
      const double level = fields[t][vertex] + persistence - threshold;
      bool stands = false;
      for (Id v = 0; v < mesh.vertices(); ++v)
        stands |= steps[t].minimum_of[v] == vertex && std::max(fields[t][v], fields[t + 1][v]) < level;
      if (steps[t].minimum_of[next] == vertex) {
        fate.vertex = next;
      } else {
        fate = {stands ? TrackEnd::merge : TrackEnd::death, stands ? next : no_id};
      }
    }
  }
  return fates;
}

std::vector<Values> random_steps(Id vertices, unsigned seed, int count) {
  std::mt19937 random(seed);
  std::vector<Values> steps(1, Values(vertices));
  for (double& value : steps[0]) value = random() % 64;
  while (static_cast<int>(steps.size()) < count) {
    steps.push_back(steps.back());
    for (double& value : steps.back()) {
      if (random() % 4 == 0) value = random() % 64;
    }
  }
  return steps;
}

/// Sums of Gaussians on a grid of side 1.
class Bumps {
 public:
  struct Bump {
    double x, y, height;
  };

  explicit Bumps(int n) : grid_(io::make_grid(n)) {
    const auto& points = std::get<io::Dataset::Points<float>>(grid_.points);
    mesh_.emplace(make_mesh(points, grid_.tetrahedra, 100));
    scale_ = 1.0 / (n - 1);
  }

  const Mesh& mesh() const { return *mesh_; }

  Values field(const std::vector<Bump>& bumps, double sign) const {
    Values values;
    for (Id v = 0; v < mesh_->vertices(); ++v) {
      double sum = 0;
      for (const Bump& bump : bumps) sum += bump.height * std::exp(-square_distance(v, bump) / (2 * 0.08 * 0.08));
      values.push_back(sign * sum);
    }
    return values;
  }

  bool is_at(Id vertex, const Bump& bump) const { return square_distance(vertex, bump) < 0.06 * 0.06; }

 private:
  double square_distance(Id v, const Bump& bump) const {
    const auto& points = std::get<io::Dataset::Points<float>>(grid_.points);
    const double x = scale_ * points(v, 0) - bump.x, y = scale_ * points(v, 1) - bump.y,
                 z = scale_ * points(v, 2) - 0.5;
    return x * x + y * y + z * z;
  }

  io::Dataset grid_;
  std::optional<Mesh> mesh_;
  double scale_;
};

}  // namespace

TEST(Tracking, follows_minima_as_edges_alone_say) {
  for (const std::string name : {"holed_grid_9", "several_components", "cone_over_sphere_200"}) {
    const InputMesh& input = mesh_named(name);
    const Mesh mesh = encode(input, 20);
    const auto steps = random_steps(input.vertices(), 7, 6);
    for (const double threshold : {0.0, 5.0, 25.0}) {
      SCOPED_TRACE(name + ", threshold " + std::to_string(threshold));
      EXPECT_EQ(fates_of(track(mesh, steps, threshold), false), brute_fates(input, steps, threshold));
    }
  }
}

TEST(Tracking, follows_bumps_that_move_merge_split_appear_and_vanish) {
  const Bumps bumps(22);
  // A moves; B approaches it, and is part of it from step 5 on; D stays, and its part E leaves it at step 4; C is there
  // from step 2 to 5. Two bumps of 0.08 are apart where they are 0.23 apart, and aren't at 0.19: the dip between them
  // is of 0.24 there, of none here.
  const auto bumps_at = [](int t) {
    using Bump = Bumps::Bump;
    const Bump a{0.2 + 0.02 * t, 0.25, 1}, b{std::max(0.75 - 0.06 * t, a.x + 0.08), 0.25, 0.9}, d{0.2, 0.8, 0.95},
        e{0.24 + 0.05 * t, 0.8, 0.8}, c{0.8, 0.8, 0.7};
    std::map<char, Bump> all{{'A', a}, {'D', d}};
    std::vector<Bump> sum{a, b, d, e};
    if (t < 5) all['B'] = b;
    if (t >= 4) all['E'] = e;
    if (t >= 2 && t <= 5) {
      all['C'] = c;
      sum.push_back(c);
    }
    return std::pair(all, sum);
  };
  for (const double sign : {1.0, -1.0}) {
    std::vector<Values> steps;
    for (int t = 0; t < 8; ++t) steps.push_back(bumps.field(bumps_at(t).second, sign));
    const Tracks found = track(bumps.mesh(), steps, 0.1);
    std::map<char, const Track*> of;
    for (const Track& track : found.tracks) {
      if (found.extrema[track.extrema[0]].is_maximum != (sign > 0)) continue;
      char name = '?';
      for (const Id place : track.extrema) {
        const TrackedExtremum& one = found.extrema[place];
        for (const auto& [letter, bump] : bumps_at(one.step).first) {
          const Bumps::Bump near{letter == 'A' && one.step >= 4  ? bump.x + 0.04
                                 : letter == 'D' && one.step < 4 ? bump.x + 0.03
                                                                 : bump.x,
                                 bump.y, 1};
          if (!bumps.is_at(one.vertex, near)) continue;
          EXPECT_TRUE(name == '?' || name == letter) << name << letter << one.step;
          name = letter;
        }
      }
      EXPECT_EQ(of.count(name), 0) << name;
      of[name] = &track;
    }
    ASSERT_EQ(of.size(), 5u);
    const auto first = [&](char name) { return found.extrema[of.at(name)->extrema.front()].step; };
    const auto last = [&](char name) { return found.extrema[of.at(name)->extrema.back()].step; };
    const auto at = [&](Id place) { return std::pair(found.extrema[place].track, found.extrema[place].step); };
    const auto number = [&](char name) { return static_cast<Id>(of.at(name) - found.tracks.data()); };
    EXPECT_EQ(std::tuple(first('A'), last('A'), of['A']->begin, of['A']->end),
              std::tuple(0, 7, TrackBegin::first_step, TrackEnd::last_step));
    EXPECT_EQ(std::tuple(first('B'), last('B'), of['B']->begin, of['B']->end),
              std::tuple(0, 4, TrackBegin::first_step, TrackEnd::merge));
    EXPECT_EQ(at(of['B']->end_at), std::pair(number('A'), 5));
    EXPECT_EQ(std::tuple(first('C'), last('C'), of['C']->begin, of['C']->end),
              std::tuple(2, 5, TrackBegin::birth, TrackEnd::death));
    EXPECT_EQ(std::tuple(first('D'), last('D'), of['D']->begin, of['D']->end),
              std::tuple(0, 7, TrackBegin::first_step, TrackEnd::last_step));
    EXPECT_EQ(std::tuple(first('E'), last('E'), of['E']->begin, of['E']->end),
              std::tuple(4, 7, TrackBegin::split, TrackEnd::last_step));
    EXPECT_EQ(at(of['E']->begin_at), std::pair(number('D'), 3));
  }
}

TEST(Tracking, follows_maxima_as_simplified_complexes_have_them) {
  const Bumps grid(9);
  const Mesh& mesh = grid.mesh();
  const auto steps = random_steps(mesh.vertices(), 3, 4);
  const double threshold = 6;
  const Tracks found = track(mesh, steps, threshold);
  MorseSmaleParts manifolds;
  manifolds.descending_separatrices = manifolds.ascending_separatrices = manifolds.saddle_connectors = false;
  std::vector<MorseSmaleComplex> complexes;
  for (const Values& field : steps) {
    SimplifyOptions options;
    options.extrema_only = true;
    complexes.push_back(simplify(
        find_morse_smale_complex(gradient_of(mesh, field), manifolds), [&](Id v) { return field[v]; }, threshold,
        options));
  }
  std::size_t all = 0;
  for (Id t = 0; t < 4; ++t) {
    std::vector<Id> expected, there;
    for (const Id cell : complexes[t].critical.cells) {
      const auto corners = mesh.cell_reader()(cell);
      const auto is_below = [&](Id a, Id b) { return std::pair(steps[t][a], a) < std::pair(steps[t][b], b); };
      Id highest = mesh.vertices_in_input()[corners[0]];
      for (int k = 1; k < 4; ++k) highest = std::max(highest, mesh.vertices_in_input()[corners[k]], is_below);
      expected.push_back(highest);
    }
    std::sort(expected.begin(), expected.end());
    for (Id i = found.step_begin[t]; i < found.step_begin[t + 1]; ++i) {
      if (found.extrema[i].is_maximum) there.push_back(found.extrema[i].vertex);
    }
    EXPECT_EQ(there, expected);
    all += there.size();
  }
  EXPECT_GT(all, 4u);
  const auto holder = [&](Id step, Id vertex) { return complexes[step].ascending_manifold.in<HostMemory>()(vertex); };
  for (const auto& [at, fate] : fates_of(found, true)) {
    if (at.first == 3) continue;
    if (fate.end == TrackEnd::last_step) {
      EXPECT_EQ(holder(at.first + 1, at.second), holder(at.first + 1, fate.vertex));
      EXPECT_EQ(holder(at.first, at.second), holder(at.first, fate.vertex));
    } else if (fate.end == TrackEnd::merge) {
      EXPECT_EQ(holder(at.first + 1, at.second), holder(at.first + 1, fate.vertex));
      EXPECT_NE(holder(at.first, at.second), holder(at.first, fate.vertex));
    }
  }
}

TEST(Tracking, takes_steps_of_one_mesh) {
  const InputMesh& input = mesh_named("one_tetrahedron");
  const Values field(input.vertices(), 1);
  ExtremumTracker tracker;
  const auto value = [](Id) { return 1.0; };
  tracker.add(0, gradient_of(encode(input, 20), field), value);
  EXPECT_EQ(message_of([&] { tracker.add(1, gradient_of(encode(input, 20), field), value); }),
            "step 1 has another mesh than the steps before it: tracks are of one mesh");
  EXPECT_EQ(tracker.tracks().times.size(), 1u);
}

TEST(Tracking, refuses_steps_that_are_none) {
  const InputMesh& input = mesh_named("one_tetrahedron");
  const DiscreteGradient gradient = gradient_of(encode(input, 20), Values(input.vertices(), 1));
  ExtremumTracker tracker;
  const auto value = [](Id) { return 1.0; };
  const auto message = [&](double time, double threshold, int threads) {
    return message_of([&] { tracker.add(time, gradient, value, threshold, threads); });
  };
  EXPECT_EQ(message(std::nan(""), 0, 1), "the time of step 0 is NaN");
  EXPECT_EQ(message(2, 0, 1), "no error");
  EXPECT_EQ(message(3, -3, 1), "the persistence -3 is not 0 or more");
  EXPECT_EQ(message(3, 0, 0), "threads is 0, not 1 to 1024");
  EXPECT_EQ(message_of([&] { tracker.add(3, gradient, nullptr); }), "tracks need the field's values");
  EXPECT_EQ(tracker.tracks().times.size(), 1u);
}

}  // namespace gale::test
