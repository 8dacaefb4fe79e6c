/**
 * @class vtkGaleMergeTree
 * @brief the join, split or contour tree of a scalar field
 *
 * Its outputs have the ports and the array names of TTK's:
 *
 * - 0: the nodes, a vtkPolyData with a vertex for each, from the lowest to the highest;
 * - 1: the arcs, a vtkPolyData of lines;
 * - 2: the mesh with the point arrays SegmentationId, RegionType, RegionSize and RegionSpan.
 */
#ifndef vtkGaleMergeTree_h
#define vtkGaleMergeTree_h

#include "vtkGaleAlgorithm.h"
#include "vtkObjectFactory.h"     // for New
#include "vtkPolyData.h"          // for the outputs
#include "vtkUnstructuredGrid.h"  // for the outputs

class VTKFILTERSGALE_EXPORT vtkGaleMergeTree : public vtkGaleAlgorithm {
 public:
  static vtkGaleMergeTree* New() { VTK_STANDARD_NEW_BODY(vtkGaleMergeTree); }
  vtkTypeMacro(vtkGaleMergeTree, vtkGaleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override {
    this->Superclass::PrintSelf(os, indent);
    os << indent << "TreeType: " << this->TreeType << "\n";
    os << indent << "Simplify: " << this->Simplify << "\n";
    os << indent << "Persistence: " << this->Persistence << "\n";
    os << indent << "PersistenceIsPercent: " << this->PersistenceIsPercent << "\n";
    os << indent << "ArcSamples: " << this->ArcSamples << "\n";
  }

  //@{
  /**
   * Which tree: 0, the default, of level sets (contour), 1 of what is below a value (join), 2 above it (split).
   */
  vtkSetClampMacro(TreeType, int, 0, 2);
  vtkGetMacro(TreeType, int);
  //@}

  //@{
  /**
   * Whether to leave out branches whose values differ by less than Persistence; off by default.
   */
  vtkSetMacro(Simplify, bool);
  vtkGetMacro(Simplify, bool);
  vtkBooleanMacro(Simplify, bool);
  //@}

  //@{
  /**
   * The threshold: in percent of the field's range if PersistenceIsPercent is on, the default, else a difference of
   * values. At least 0; 1 by default.
   */
  vtkSetClampMacro(Persistence, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Persistence, double);
  vtkSetMacro(PersistenceIsPercent, bool);
  vtkGetMacro(PersistenceIsPercent, bool);
  vtkBooleanMacro(PersistenceIsPercent, bool);
  //@}

  //@{
  /**
   * Arcs are drawn over at most so many points between their ends; 0 by default.
   */
  vtkSetClampMacro(ArcSamples, int, 0, 1000);
  vtkGetMacro(ArcSamples, int);
  //@}

  //@{
  /**
   * The outputs. GetOutput is that of a port: 0 unless said.
   */
  vtkPolyData* GetOutput() { return this->GetNodes(); }
  vtkDataObject* GetOutput(int port) { return this->GetOutputDataObject(port); }
  vtkPolyData* GetNodes() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0)); }
  vtkPolyData* GetArcs() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1)); }
  vtkUnstructuredGrid* GetSegmentation() { return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(2)); }
  //@}

 protected:
  vtkGaleMergeTree() : vtkGaleAlgorithm("merge-tree", 3, 2) {}

  void Ask() override {
    this->AskChoice("type", this->TreeType);
    if (this->Simplify) this->AskThreshold("persistence", this->Persistence, this->PersistenceIsPercent);
    this->AskNumber("arc_samples", this->ArcSamples);
  }

  int TreeType = 0;
  bool Simplify = false;
  double Persistence = 1;
  bool PersistenceIsPercent = true;
  int ArcSamples = 0;

 private:
  vtkGaleMergeTree(const vtkGaleMergeTree&) = delete;
  void operator=(const vtkGaleMergeTree&) = delete;
};

#endif
