// What a fuzzer hands over, given to the readers as a file: one function a reader, see
// tests/fuzz/CMakeLists.txt.
#pragma once
#include <string_view>

namespace fuzz {

/// Each reads `bytes` as its reader would read a file of that content. What a reader may say of a wrong file
/// (dem::InputError, dem::RunError) is taken; anything else is a finding and goes through.
void calibrate_case(std::string_view bytes);  ///< spall calibrate's case.toml
void study_file(std::string_view bytes);      ///< spall study's study.toml, with its plan
void impact_scene(std::string_view bytes);    ///< spall impact's case.toml
void card(std::string_view bytes);            ///< a material card
void curve(std::string_view bytes);           ///< a laboratory's CSV
void stl(std::string_view bytes);             ///< an impactor's surface
void gmsh(std::string_view bytes);            ///< a finite-element mesh
void gmsh_content(std::string_view bytes);    ///< what Gmsh's library found in one
void specimen(std::string_view bytes);        ///< a specimen (HDF5)
void checkpoint(std::string_view bytes);      ///< the checkpoint of a test or an impact (HDF5)
void journal(std::string_view bytes);         ///< a calibration's journal (HDF5)

}  // namespace fuzz
