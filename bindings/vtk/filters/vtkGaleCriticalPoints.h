/**
 * @class vtkGaleCriticalPoints
 * @brief the critical points of a piecewise linear scalar field
 *
 * The output is a vtkPolyData with a vertex for each critical point, by ascending point of the mesh, and the point
 * arrays CriticalType (0 minimum, 1 and 2 saddles, 3 maximum, 4 degenerate), IsOnBoundary, ttkVertexScalarField (the
 * point of the mesh) and those of the input.
 */
#ifndef vtkGaleCriticalPoints_h
#define vtkGaleCriticalPoints_h

#include "vtkGaleAlgorithm.h"
#include "vtkObjectFactory.h"  // for New
#include "vtkPolyData.h"       // for the output

class VTKFILTERSGALE_EXPORT vtkGaleCriticalPoints : public vtkGaleAlgorithm {
 public:
  static vtkGaleCriticalPoints* New() { VTK_STANDARD_NEW_BODY(vtkGaleCriticalPoints); }
  vtkTypeMacro(vtkGaleCriticalPoints, vtkGaleAlgorithm);

  //@{
  /**
   * The critical points: port 0 is the only one.
   */
  vtkPolyData* GetOutput() { return this->GetOutput(0); }
  vtkPolyData* GetOutput(int port) { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(port)); }
  //@}

 protected:
  vtkGaleCriticalPoints() : vtkGaleAlgorithm("critical-points", 1, -1) {}
  void Ask() override {}

 private:
  vtkGaleCriticalPoints(const vtkGaleCriticalPoints&) = delete;
  void operator=(const vtkGaleCriticalPoints&) = delete;
};

#endif
