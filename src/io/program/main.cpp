// gale-vtk-reader FORMAT FILE: reads a file by VTK and writes its mesh or image to descriptor 3 as a .vtu or .vti. What
// is wrong goes to descriptor 4, a line, with exit code 1; with 0 it is a notice. GALE runs it; whatever FILE does to
// VTK's readers ends here.
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <fstream>
#include <string>

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "readers.hpp"

namespace {

constexpr char result_path[] = "/proc/self/fd/3";
constexpr int message_number = 4;

/// VTK's messages: the first error is kept.
class FirstError : public vtkOutputWindow {
 public:
  static FirstError* New();
  vtkTypeMacro(FirstError, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    if (said.empty()) said = text;
  }
  void DisplayGenericWarningText(const char*) override {}
  void DisplayWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}

  std::string said;
};
vtkStandardNewMacro(FirstError);

/// "ERROR: In FILE, line N\nvtkClass (0x...): the message\n\n" from the message on.
std::string message_of(std::string text) {
  text.erase(0, std::min(text.find('\n') + 1, text.size()));
  const std::size_t object = text.find("): ");
  if (object != std::string::npos) text.erase(0, object + 3);
  text.erase(std::min(text.find('\n'), text.size()));
  return text;
}

/// What this process has mapped already.
rlim_t mapped_bytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// A file can't stand for more than its bytes inflated, nor take long.
void limit_to(const std::string& path) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  struct stat file = {};
  const rlim_t bytes = stat(path.c_str(), &file) == 0 ? static_cast<rlim_t>(file.st_size) : 0;
  const auto limit = [](int resource, rlim_t most) {
    rlimit now;
    getrlimit(static_cast<__rlimit_resource_t>(resource), &now);
    now.rlim_cur = std::min(now.rlim_max, most);
    setrlimit(static_cast<__rlimit_resource_t>(resource), &now);
  };
  constexpr rlim_t more = rlim_t(2) << 30, best_ratio = 1032, seconds = 60, bytes_a_second = 1000000;
  limit(RLIMIT_AS, mapped_bytes() + more + best_ratio * bytes);
  limit(RLIMIT_CPU, seconds + bytes / bytes_a_second);
  limit(RLIMIT_CORE, 0);
}

bool say(const std::string& line) {
  return write(message_number, line.data(), line.size()) == static_cast<ssize_t>(line.size());
}

int fail(const std::string& why) { return say(why) ? 1 : 2; }

template <class Writer>
bool write_as(vtkDataSet* data) {
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->SetFileName(result_path);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  return writer->Write() != 0;
}

int read(const std::string& format, const std::string& path) {
  const auto messages = vtkSmartPointer<FirstError>::New();
  vtkOutputWindow::SetInstance(messages);
  const bool is_exodus = format == "exodus";
  const auto [data, notice] = is_exodus ? gale::reader::read_exodus(path) : gale::reader::read_vtkhdf(path);
  if (!messages->said.empty()) {
    return fail("it is damaged, incomplete or of another format (VTK's reader says: " + message_of(messages->said) +
                ")");
  }
  if (!data) return fail(is_exodus ? "it is no Exodus II file" : "it is no VTKHDF file of a mesh or an image");
  data->GetCellData()->Initialize();
  data->GetFieldData()->Initialize();
  bool is_written = false;
  if (vtkUnstructuredGrid::SafeDownCast(data)) {
    if (data->GetNumberOfCells() == 0) return fail("it has no tetrahedra");
    is_written = write_as<vtkXMLUnstructuredGridWriter>(data);
  } else if (vtkImageData::SafeDownCast(data)) {
    is_written = write_as<vtkXMLImageDataWriter>(data);
  } else {
    return fail(std::string("it holds a ") + data->GetClassName() + ", neither a mesh nor an image");
  }
  if (!is_written || !messages->said.empty()) return fail("there is no memory for what is in it");
  return say(notice) ? 0 : 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 || (std::string(argv[1]) != "exodus" && std::string(argv[1]) != "vtkhdf")) return 2;
  limit_to(argv[2]);
  try {
    return read(argv[1], argv[2]);
  } catch (const std::bad_alloc&) {
    return fail("not enough memory for what it says of its sizes");
  } catch (const std::exception& error) {
    return fail(std::string("VTK's reader says: ") + error.what());
  }
}
