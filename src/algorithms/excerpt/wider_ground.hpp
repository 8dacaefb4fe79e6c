#pragma once

#include <gale/algorithms/excerpt/wider_gradient.hpp>
#include <gale/algorithms/excerpt/wider_keys.hpp>
#include <gale/algorithms/morse_smale/descending_wall.hpp>

namespace gale::detail {

/// A wider gradient as walls on the host read it. Takes 8 bytes a vertex for rows, unless a grid's codes stand for
/// them, beside WiderKeys and a copy of the successors of others' vertices. Refers to the gradient.
class WiderGround {
 public:
  explicit WiderGround(const WiderGradient& wider);

  WallGround ground() const;

 private:
  void fill_rows();

  const WiderGradient& wider_;
  const WiderKeys keys_;
  const WiderKeysIn<HostMemory> keys_here_;
  MoreSuccessors vertex_successors_;
  EdgePairs pairs_;
};

}  // namespace gale::detail
