// What a run looked like in space and time, ready to be drawn: elements as spheres, a mesh, a body. Plain
// columns, SI units, single precision: pictures need no more.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace report {

/// Elements, and beside them a mesh and a body if there are any, over one or more frames. Whoever draws it
/// shows the last frame first, where the damage is.
struct Scene {
  /// A value of every element by which it can be coloured.
  struct Field {
    std::string name;  ///< "damage"
    std::string unit = "";
    double from = 0;  ///< ends of the colour scale, in `unit`
    double to = 1;
  };
  struct Frame {
    double time = 0;                         ///< or what else orders the frames
    std::string label;                       ///< what a reader calls this moment: "t = 1.20 ms"
    std::vector<float> displacements;        ///< of the elements since `centres` [m], x y z each
    std::vector<std::vector<float>> values;  ///< by field, in the order of `fields`: one value an element
    std::vector<float> mesh_displacements;   ///< of the mesh's nodes [m], x y z each
    std::vector<float> body_points;          ///< where the body's points are [m], x y z each
  };
  /// A link that broke, and the first frame that shows it broken.
  struct BrokenLink {
    std::uint32_t first = 0, second = 0;  ///< its elements
    std::uint32_t frame = 0;
  };

  std::string title;
  std::string caption = "";
  std::vector<float> centres;                 ///< of the elements at the start [m], x y z each
  std::vector<float> radii;                   ///< [m]
  std::vector<float> mesh_nodes;              ///< at the start [m], x y z each; empty without a mesh
  std::vector<std::uint32_t> mesh_faces;      ///< the mesh's outer faces: four nodes each
  std::vector<std::uint32_t> body_triangles;  ///< three of the body's points each; empty without a body
  std::vector<Field> fields;
  std::vector<BrokenLink> broken_links;  ///< sorted by frame
  std::vector<Frame> frames;             ///< at least one, in order

  std::size_t elements() const { return radii.size(); }
};

}  // namespace report
