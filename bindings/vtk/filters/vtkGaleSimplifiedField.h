/**
 * @class vtkGaleSimplifiedField
 * @brief a scalar field without its minima and maxima of little persistence
 *
 * The output is the mesh with the simplified field in place of the point array NAME that was given, and NAME_Order, the
 * order of its points, which other filters go by.
 */
#ifndef vtkGaleSimplifiedField_h
#define vtkGaleSimplifiedField_h

#include "vtkGaleAlgorithm.h"
#include "vtkObjectFactory.h"     // for New
#include "vtkUnstructuredGrid.h"  // for the output

class VTKFILTERSGALE_EXPORT vtkGaleSimplifiedField : public vtkGaleAlgorithm {
 public:
  static vtkGaleSimplifiedField* New() { VTK_STANDARD_NEW_BODY(vtkGaleSimplifiedField); }
  vtkTypeMacro(vtkGaleSimplifiedField, vtkGaleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override {
    this->Superclass::PrintSelf(os, indent);
    os << indent << "Simplify: " << this->Simplify << "\n";
    os << indent << "Persistence: " << this->Persistence << "\n";
    os << indent << "PersistenceIsPercent: " << this->PersistenceIsPercent << "\n";
  }

  //@{
  /**
   * Whether to remove minima and maxima of less persistence than Persistence; off by default: then the field stays.
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
   * The mesh with the field: port 0 is the only one.
   */
  vtkUnstructuredGrid* GetOutput() { return this->GetOutput(0); }
  vtkUnstructuredGrid* GetOutput(int port) {
    return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(port));
  }
  //@}

 protected:
  vtkGaleSimplifiedField() : vtkGaleAlgorithm("simplify-field", 1, 0) {}

  void Ask() override {
    if (this->Simplify) this->AskThreshold("persistence", this->Persistence, this->PersistenceIsPercent);
  }

  bool Simplify = false;
  double Persistence = 1;
  bool PersistenceIsPercent = true;

 private:
  vtkGaleSimplifiedField(const vtkGaleSimplifiedField&) = delete;
  void operator=(const vtkGaleSimplifiedField&) = delete;
};

#endif
