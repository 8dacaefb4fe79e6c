#pragma once

#include <string>
#include <vector>

#include <gale/io/dataset.hpp>
#include <gale/io/image.hpp>
#include <gale/io/vtk/vtk_messages.hpp>

#if __has_include(<vtkABINamespace.h>)  // VTK 9.2 and later
#include <vtkABINamespace.h>
#else
#define VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_END
#endif

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
class vtkImageData;
VTK_ABI_NAMESPACE_END

/// From VTK's data sets to GALE's, for the vtk_*.cpp. Throw `Error` without naming the file.
namespace gale::io::detail {

/// Any data set: what is no unstructured grid counts as one whose cells are no tetrahedra.
Dataset to_mesh(vtkDataSet* data, bool tetrahedralize, const VtkMessages& messages);

Image to_image(vtkImageData* data);

}  // namespace gale::io::detail
