/**
 * @class vtkGaleMorseSmaleComplex
 * @brief the Morse-Smale complex of a scalar field, simplified if wanted
 *
 * Its outputs have the ports and the array names of TTK's:
 *
 * - 0: the critical simplices, a vtkPolyData with a vertex for each;
 * - 1: the 1-separatrices, a vtkPolyData of lines;
 * - 2: the 2-separatrices, a vtkPolyData of polygons;
 * - 3: the mesh with the point arrays DescendingManifold, AscendingManifold and MorseSmaleManifold.
 */
#ifndef vtkGaleMorseSmaleComplex_h
#define vtkGaleMorseSmaleComplex_h

#include "vtkGaleAlgorithm.h"
#include "vtkObjectFactory.h"     // for New
#include "vtkPolyData.h"          // for the outputs
#include "vtkUnstructuredGrid.h"  // for the outputs

class VTKFILTERSGALE_EXPORT vtkGaleMorseSmaleComplex : public vtkGaleAlgorithm {
 public:
  static vtkGaleMorseSmaleComplex* New() { VTK_STANDARD_NEW_BODY(vtkGaleMorseSmaleComplex); }
  vtkTypeMacro(vtkGaleMorseSmaleComplex, vtkGaleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override {
    this->Superclass::PrintSelf(os, indent);
    os << indent << "Simplify: " << this->Simplify << "\n";
    os << indent << "Persistence: " << this->Persistence << "\n";
    os << indent << "PersistenceIsPercent: " << this->PersistenceIsPercent << "\n";
    os << indent << "ExtremaOnly: " << this->ExtremaOnly << "\n";
    os << indent << "ComputeDescendingSeparatrices1: " << this->ComputeDescendingSeparatrices1 << "\n";
    os << indent << "ComputeAscendingSeparatrices1: " << this->ComputeAscendingSeparatrices1 << "\n";
    os << indent << "ComputeSaddleConnectors: " << this->ComputeSaddleConnectors << "\n";
    os << indent << "ComputeSeparatrices2: " << this->ComputeSeparatrices2 << "\n";
    os << indent << "ComputeDescendingSegmentation: " << this->ComputeDescendingSegmentation << "\n";
    os << indent << "ComputeAscendingSegmentation: " << this->ComputeAscendingSegmentation << "\n";
  }

  //@{
  /**
   * Whether to cancel pairs of critical simplices whose values differ by less than Persistence; off by default.
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
   * Whether to cancel minima and maxima, but no saddles with one another: faster. Off by default.
   */
  vtkSetMacro(ExtremaOnly, bool);
  vtkGetMacro(ExtremaOnly, bool);
  vtkBooleanMacro(ExtremaOnly, bool);
  //@}

  //@{
  /**
   * Which parts are wanted: all by default, but for the 2-separatrices, which are large.
   */
  vtkSetMacro(ComputeDescendingSeparatrices1, bool);
  vtkGetMacro(ComputeDescendingSeparatrices1, bool);
  vtkBooleanMacro(ComputeDescendingSeparatrices1, bool);
  vtkSetMacro(ComputeAscendingSeparatrices1, bool);
  vtkGetMacro(ComputeAscendingSeparatrices1, bool);
  vtkBooleanMacro(ComputeAscendingSeparatrices1, bool);
  vtkSetMacro(ComputeSaddleConnectors, bool);
  vtkGetMacro(ComputeSaddleConnectors, bool);
  vtkBooleanMacro(ComputeSaddleConnectors, bool);
  vtkSetMacro(ComputeSeparatrices2, bool);
  vtkGetMacro(ComputeSeparatrices2, bool);
  vtkBooleanMacro(ComputeSeparatrices2, bool);
  vtkSetMacro(ComputeDescendingSegmentation, bool);
  vtkGetMacro(ComputeDescendingSegmentation, bool);
  vtkBooleanMacro(ComputeDescendingSegmentation, bool);
  vtkSetMacro(ComputeAscendingSegmentation, bool);
  vtkGetMacro(ComputeAscendingSegmentation, bool);
  vtkBooleanMacro(ComputeAscendingSegmentation, bool);
  //@}

  //@{
  /**
   * The outputs. GetOutput is that of a port: 0 unless said.
   */
  vtkPolyData* GetOutput() { return this->GetCriticalPoints(); }
  vtkDataObject* GetOutput(int port) { return this->GetOutputDataObject(port); }
  vtkPolyData* GetCriticalPoints() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0)); }
  vtkPolyData* GetSeparatrices1() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1)); }
  vtkPolyData* GetSeparatrices2() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(2)); }
  vtkUnstructuredGrid* GetSegmentation() { return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(3)); }
  //@}

 protected:
  vtkGaleMorseSmaleComplex() : vtkGaleAlgorithm("morse-smale", 4, 3) {}

  void Ask() override {
    this->AskFlag("descending_separatrices", this->ComputeDescendingSeparatrices1);
    this->AskFlag("ascending_separatrices", this->ComputeAscendingSeparatrices1);
    this->AskFlag("saddle_connectors", this->ComputeSaddleConnectors);
    this->AskFlag("separatrices2", this->ComputeSeparatrices2);
    this->AskFlag("descending_segmentation", this->ComputeDescendingSegmentation);
    this->AskFlag("ascending_segmentation", this->ComputeAscendingSegmentation);
    this->AskFlag("extrema_only", this->ExtremaOnly);
    if (this->Simplify) this->AskThreshold("persistence", this->Persistence, this->PersistenceIsPercent);
  }

  bool Simplify = false;
  double Persistence = 1;
  bool PersistenceIsPercent = true;
  bool ExtremaOnly = false;
  bool ComputeDescendingSeparatrices1 = true;
  bool ComputeAscendingSeparatrices1 = true;
  bool ComputeSaddleConnectors = true;
  bool ComputeSeparatrices2 = false;
  bool ComputeDescendingSegmentation = true;
  bool ComputeAscendingSegmentation = true;

 private:
  vtkGaleMorseSmaleComplex(const vtkGaleMorseSmaleComplex&) = delete;
  void operator=(const vtkGaleMorseSmaleComplex&) = delete;
};

#endif
