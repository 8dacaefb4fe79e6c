#pragma once

#include <functional>
#include <string>
#include <vector>

#include <vtkImageData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <gale/io/write.hpp>

class vtkAlgorithm;
class vtkFieldData;
class vtkPolyData;

namespace gale::test {

/// grid:N as GALE makes it.
io::Dataset synthetic(int n);

/// A mesh as VTK has it: float points, cells of 64 bits, and the point array "field", which is the active scalars.
vtkSmartPointer<vtkUnstructuredGrid> grid_of(const io::Dataset& dataset);

/// An image of its points: its tetrahedra are those that it is split into.
vtkSmartPointer<vtkImageData> image_of(const io::Dataset& dataset, int n);

/// What outputs are made from: the dataset's points with no arrays.
io::Dataset points_alone(const io::Dataset& dataset);

/// Are these among the arrays of `found`, with the same types and values?
void expect_arrays(vtkFieldData* found, const std::vector<io::PointArray>& expected);

/// Has `found` these points, bit by bit?
void expect_points(vtkPolyData* found, const io::Dataset::Positions& expected);

/// What the filter says where it fails; "no error" where it doesn't.
std::string error_of(vtkAlgorithm& filter);

/// What the filter says where `update` makes it work; "no error" where it doesn't fail.
std::string error_of(vtkAlgorithm& filter, const std::function<void()>& update);

/// What the filter warns of; "" for nothing.
std::string warning_of(vtkAlgorithm& filter);

/// A text with all that is in a data object.
std::string content_of(vtkDataObject* data);

}  // namespace gale::test
