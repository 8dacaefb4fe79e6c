/**
 * @class vtkGaleSegmentation
 * @brief the segments that a tetrahedral mesh is divided into
 *
 * The output is the mesh with the point array ttkCompactTriangulationIndex: the segment of each point, by an octree
 * whose leaves have at most Capacity points. Localized data structures read it.
 */
#ifndef vtkGaleSegmentation_h
#define vtkGaleSegmentation_h

#include "vtkGaleAlgorithm.h"
#include "vtkObjectFactory.h"     // for New
#include "vtkUnstructuredGrid.h"  // for the output

class VTKFILTERSGALE_EXPORT vtkGaleSegmentation : public vtkGaleAlgorithm {
 public:
  static vtkGaleSegmentation* New() { VTK_STANDARD_NEW_BODY(vtkGaleSegmentation); }
  vtkTypeMacro(vtkGaleSegmentation, vtkGaleAlgorithm);

  //@{
  /**
   * The mesh with its segments: port 0 is the only one.
   */
  vtkUnstructuredGrid* GetOutput() { return this->GetOutput(0); }
  vtkUnstructuredGrid* GetOutput(int port) {
    return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(port));
  }
  //@}

 protected:
  vtkGaleSegmentation() : vtkGaleAlgorithm(nullptr, 1, 0) {}
  void Ask() override {}

 private:
  vtkGaleSegmentation(const vtkGaleSegmentation&) = delete;
  void operator=(const vtkGaleSegmentation&) = delete;
};

#endif
