// How gmsh_server.cpp is spoken to.
#pragma once

namespace gmsh_server {

// File descriptors that it is started with.
constexpr int requests = 10, answers = 11, found = 12;
// Answers.
constexpr char whole = 'w', failed = 'f', crashed = 'c';

}  // namespace gmsh_server
