# The public headers, by folder: what a user of the library includes. They are installed, and each compiles alone
# (unit_tests/install/headers, built by scripts/test-compilers.sh). To publish a header, name it here.
#
# Public headers include others of ours, which are installed too, but which nobody should include by themselves: these
# are in gale_included_headers. unit_tests/headers tells when that list is too long or too short.

set(gale_public_headers "")

# gale_public(<folder> <header without .hpp>...)
function(gale_public folder)
  list(TRANSFORM ARGN PREPEND ${folder}/)
  list(TRANSFORM ARGN APPEND .hpp)
  set(gale_public_headers ${gale_public_headers} ${ARGN} PARENT_SCOPE)
endfunction()

gale_public(base atomic configuration csr error kokkos memory stop team threads types)
gale_public(mesh cells/cell_types cells/split_cells encoded_mesh exchange grid input_numbers intervals make_mesh mesh ranks segmentation simplices)
gale_public(relations batch faces preconditioning relation rows segment_rows)
gale_public(runtime computation consumer device_sweep graph_of make_structure relation_of statistics structure structure_options sweep_options)
gale_public(algorithms critical_points critical_simplices discrete_gradient gathered_gradient merge_tree morse_smale persistence separatrices
  simplex_numbers simplify simplify_field surface_vertices tracking vertex_order)
gale_public(outputs analyses arrows critical_points critical_simplices excerpt field manifolds merge_tree mesh_piece morse_smale named_simplices persistence
  segmentation separatrices1 separatrices2 simplified_field tracks)
gale_public(io atomic_file dataset formats image read synthetic write)
if(GALE_ENABLE_MPI)
  gale_public(distributed communicator distributed_mesh grid_layers mesh_part)
endif()

set(gale_included_headers
  base/bits.hpp
  base/mirrored.hpp
  base/parallel.hpp
  base/transfer.hpp
  mesh/grid/grid_stars.hpp
  mesh/grid/grid_view.hpp
  runtime/device/batch_sweep.hpp
  runtime/batches/segment_batches.hpp)

# Made by the build, beside those of src/.
set(gale_generated_headers export.hpp version.hpp)

foreach(header IN LISTS gale_public_headers gale_included_headers)
  if(NOT EXISTS ${PROJECT_SOURCE_DIR}/src/${header})
    message(FATAL_ERROR "cmake/gale-headers.cmake names ${header}, which isn't in src/")
  endif()
endforeach()
