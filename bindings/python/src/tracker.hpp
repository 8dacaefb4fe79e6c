#pragma once

#include <optional>
#include <string>
#include <utility>

#include <gale/outputs/tracks.hpp>

#include "mesh.hpp"

namespace gale::python {

/// Extrema followed through the steps of a field.
class PyTracker : public Kept {
 public:
  void end() override { following_.reset(); }

  /// Adds a step. `threshold` is a value, and whether it is in percent of the field's range.
  void add(double time, const PyMesh& mesh, Array1 field, const std::string& name,
           const std::pair<double, bool>& threshold, int threads, const nb::object& progress);

  /// (lines through time, the columns of the table)
  nb::tuple found() const;

 private:
  struct Following {
    ExtremumTracker tracker;
    outputs::TrackLines lines;
  };
  std::optional<Following> following_{std::in_place};
};

}  // namespace gale::python
