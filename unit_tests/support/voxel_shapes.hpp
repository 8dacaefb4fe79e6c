#pragma once

#include <functional>

#include "support/input_mesh.hpp"

namespace gale::test {

/// The cubes of a grid that are `kept`, each split into six tetrahedra along its main diagonal (Freudenthal), and no
/// other vertices than theirs. All ids and corners are shuffled.
InputMesh voxels(Id cubes_x, Id cubes_y, Id cubes_z, const std::function<bool(Id x, Id y, Id z)>& kept);

/// Shapes of so many cubes a side, a multiple of 3: a ball (Euler characteristic 1), a solid torus (0), and a ball with
/// a cavity (2).
InputMesh ball(Id side);
InputMesh solid_torus(Id side);
InputMesh thick_shell(Id side);

}  // namespace gale::test
