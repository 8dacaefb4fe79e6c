#pragma once

// The libraries that files are read with: VTK's, which brings them or names the system's, or the system's alone
// (GALE_ENABLE_SYSTEM_LIBRARIES).

#ifdef GALE_TAKES_SYSTEM_LIBRARIES
#include <expat.h>
#include <lz4.h>
#include <lzma.h>
#include <zlib.h>
#else
#include <vtk_expat.h>
#include <vtk_lz4.h>
#include <vtk_lzma.h>
#include <vtk_zlib.h>
#endif
