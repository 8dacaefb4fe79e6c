#pragma once

#include <vector>

#include <vtkSmartPointer.h>

#include <gale/io/write.hpp>

class vtkDataArray;
class vtkDataSetAttributes;
class vtkPoints;
class vtkPolyData;

// VTK's arrays and GALE's. All are copied.

namespace gale::vtk {

/// With the name, the values and the components of an array of VTK's, of any type of number and any layout.
io::PointArray point_array(vtkDataArray* array);

/// The other way, in a type of VTK's of the same size.
vtkSmartPointer<vtkDataArray> data_array(const io::PointArray& array);

vtkSmartPointer<vtkPoints> points_of(const io::Dataset::Positions& positions);

void add(const std::vector<io::PointArray>& arrays, vtkDataSetAttributes* to);

/// Points with a vertex each, and their arrays. Those of `from`, the input's points, travel along: each point is where
/// its array ttkVertexScalarField says.
void to_poly_data(const io::PointSet& points, vtkDataSetAttributes* from, vtkPolyData* to);

/// Lines and polygons with the arrays of both.
void to_poly_data(const io::Surface& surface, vtkPolyData* to);

}  // namespace gale::vtk
