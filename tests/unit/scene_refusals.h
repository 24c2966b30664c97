// A sound case of an impact, and everything that is wrong with it one row at a time.
#pragma once
#include <string>
#include <vector>

namespace scene_refusals {

/// Its lines are counted in the messages below.
inline const std::string sound = R"(title = "test"
model = "coupled"
card = "card.toml"

[structure]
size = "1.0x0.5x0.28 m"
elements = 12000
seed = 7

[zone]
low = "0.2,0,0 m"
high = "0.8,0.5,0.28 m"
layers = 3

[mesh]
elements = [20, 10, 4]

[coupling]
interval = 2

[[support]]
name = "left"
low = "0,0,0 m"
high = "0.025,0.5,0.28 m"
lock = ["z"]

[impactor]
shape = "box"
size = "0.1x0.1x0.1 m"
density = "2500 kg/m3"
speed = "40 m/s"
aim = "0.5,0.25,0.14 m"

[[probe]]
name = "under"
point = "0.5,0.25,0 m"

[run]
duration = "2 ms"
)";

struct Refusal {
  std::string from, to;  ///< what stands in `sound`, once, and what is written in its place
  std::string message;   ///< with which the case is then refused
};

inline std::string with_contact(const std::string& keys) {
  return "[impactor.contact]\n" + keys + "\n[[probe]]";
}

inline std::vector<Refusal> refusals() {
  const std::string contact = "[[probe]]";
  return {
      {"title", "titel",
       "case.toml:1: titel: unknown key; did you mean \"title\"? allowed: title, model, card, structure, zone, "
       "mesh, coupling, support, impactor, probe, run, output"},
      {"\"coupled\"", "\"fem\"", "case.toml:2: model: \"fem\" is no choice here; allowed: de, coupled"},
      {"model = \"coupled\"\n", "", "case.toml: model: the key is missing; allowed: de, coupled"},
      {"\"card.toml\"", "\"none.toml\"",
       "case.toml:3: card: there is no file \"none.toml\"; name a file that exists, relative to the case file"},
      {"\"card.toml\"", "\"poor.toml\"",
       "case.toml:3: card: poor.toml: zeta: the key is missing; write it as in zeta = \"0.2\" (there is a key "
       "\"beta\": is it meant?)"},
      // structure
      {"[structure]\nsize = \"1.0x0.5x0.28 m\"\nelements = 12000\nseed = 7\n", "",
       "case.toml: structure: the table is missing; write it as [structure] with its keys on the lines below"},
      {"\"1.0x0.5x0.28 m\"", "\"1.0x0.5 m\"",
       "case.toml:6: structure.size: has 2 lengths, not three; write it as in size = \"2.5x2.0x0.28 m\""},
      {"\"1.0x0.5x0.28 m\"", "1.0",
       "case.toml:6: structure.size: 1.0 is not a list; write it as in size = [\"98.6 mm\"]"},
      {"\"1.0x0.5x0.28 m\"", "\"1.0x0.5x0 m\"",
       "case.toml:6: structure.size: has a side of 0 m; allowed: 1 mm to 1 km"},
      {"12000", "120",
       "case.toml:7: structure.elements: of 72 in 0.6 x 0.5 x 0.28 m, 0 are deeper than two element sizes; at "
       "least 100 are needed, take more elements"},
      {"12000", "0", "case.toml:7: structure.elements: 0 is out of range; it must be from 1 to 10000000"},
      {"seed = 7", "seed = -7", "case.toml:8: structure.seed: -7 is out of range; it must be at least 0"},
      {"seed = 7", "size_ratio = 0.5",
       "case.toml:8: structure.size_ratio: grading: size_ratio: is 0.5; allowed: 1 to 10"},
      {"seed = 7", "compressive_strength = \"0 MPa\"",
       "case.toml:8: structure.compressive_strength: is 0 Pa; it must be above 0"},
      {"seed = 7", "specimen = \"zone.h5\"",
       "case.toml:7: structure.elements: has no meaning beside specimen; the specimen has its elements "
       "already; leave this key out"},
      {"elements = 12000\nseed = 7", "specimen = \"none.h5\"",
       "case.toml:7: structure.specimen: there is no file \"none.h5\"; name a file that exists, relative to "
       "the case file"},
      {"elements = 12000\nseed = 7", "specimen = \"rock.stl\"",
       "case.toml:7: structure.specimen: rock.stl: is not an HDF5 file; give a file that Spall wrote (*.h5)"},
      {"\"coupled\"\ncard = \"card.toml\"\n\n[structure]\nsize = \"1.0x0.5x0.28 m\"\nelements = 12000\nseed = "
       "7",
       "\"de\"\ncard = \"card.toml\"\n[structure]\nsize = \"1.0x0.5x0.28 m\"\nspecimen = \"zone.h5\"",
       "case.toml:6: structure.specimen: it is a box of 0.6 x 0.5 x 0.28 m; it must be a box of the "
       "structure's size, 1 x 0.5 x 0.28 m"},
      // zone, mesh, coupling
      {"[zone]\nlow = \"0.2,0,0 m\"\nhigh = \"0.8,0.5,0.28 m\"\nlayers = 3\n", "",
       "case.toml: zone: the table is missing; a coupled case has [zone] and [mesh]; model = \"de\" needs "
       "neither"},
      {"low = \"0.2,0,0 m\"\nhigh", "low = \"0.9,0,0 m\"\nhigh",
       "case.toml:11: zone.low: the region reaches from 0.9 to 0.8 m along x; low must be below high along "
       "each axis"},
      {"\"0.8,0.5,0.28 m\"", "\"1.1,0.5,0.28 m\"",
       "case.toml:12: zone.high: the zone reaches from 0.2 to 1.1 m along x; it must lie inside the structure, "
       "from 0 to 1 m"},
      {"low = \"0.2,0,0 m\"\nhigh = \"0.8,0.5,0.28 m\"", "low = \"0,0,0 m\"\nhigh = \"1,0.5,0.28 m\"",
       "case.toml:11: zone.low: the zone fills the whole structure, no finite element would remain; make it "
       "smaller, or take model = \"de\""},
      {"low = \"0.2,0,0 m\"\n", "",
       "case.toml: zone.low: the key is missing; write it as in low = \"0,0,0 m\""},
      {"low = \"0.2,0,0 m\"\n", "centre = \"0.5,0.25,0.14 m\"\n",
       "case.toml:11: zone.centre: stands beside low and high; a region is given either by low and high or by "
       "centre and size"},
      {"low = \"0.2,0,0 m\"\nhigh = \"0.8,0.5,0.28 m\"",
       "centre = \"0.5,0.25,0.14 m\"\nsize = \"0.6x0.5x-0.28 m\"",
       "case.toml:12: zone.size: the region reaches from 0.28 to 0 m along z; every side must be above 0"},
      {"\"0.2,0,0 m\"", "\"0.21,0,0 m\"",
       "case.toml:16: mesh.elements: structured mesh: the zone's face at x = 0.21 m cuts elements of 0.05 m; "
       "it must lie between elements, for example at 0.2 m"},
      {"layers = 3", "layers = 6",
       "case.toml:16: mesh.elements: structured mesh: 6 overlap layers leave nothing of the zone's 12 elements "
       "along x; make the zone larger, the elements smaller, or the layers fewer"},
      {"layers = 3", "layers = 0", "case.toml:13: zone.layers: 0 is out of range; it must be from 1 to 1000"},
      {"layers = 3", "overlap = \"0.1 m\"",
       "case.toml:13: zone.overlap: is the thickness of an overlap with a mesh from a file; a structured mesh "
       "counts its overlap in elements, as in layers = 3"},
      {"low = \"0.2,0,0 m\"\nhigh = \"0.8,0.5,0.28 m\"\nlayers = 3\n\n[mesh]\nelements = [20, 10, 4]",
       "low = \"0.2,0.1,0 m\"\nhigh = \"0.8,0.4,0.28 m\"\nlayers = 2\n\n[mesh]\nelements = [20, 20, 4]",
       "case.toml:16: mesh.elements: an element measures 0.025 m along y and 0.05 m along x; across the zone's "
       "coupled faces they may differ by a tenth: the overlap has one thickness"},
      {"[mesh]\nelements = [20, 10, 4]", "",
       "case.toml: mesh: the table is missing; a coupled case has [zone] and [mesh]; model = \"de\" needs "
       "neither"},
      {"elements = [20, 10, 4]", "",
       "case.toml: mesh.elements: the key is missing; a mesh is even, as in elements = [38, 30, 4], or grows "
       "away "
       "from the zone, as in zone_elements = [16, 16, 4], or comes from a file = \"slab.msh\""},
      {"elements = [20, 10, 4]", "elements = [20, 10, 4]\nzone_elements = [12, 10, 4]",
       "case.toml:17: mesh.zone_elements: stands beside elements; a mesh is even, as in elements = [38, 30, "
       "4], or "
       "grows away from the zone, as in zone_elements = [16, 16, 4], or comes from a file = \"slab.msh\""},
      {"elements = [20, 10, 4]", "elements = [20, 10, 4]\ngrowth = 1.2",
       "case.toml:17: mesh.growth: elements that fill the structure evenly do not grow; write zone_elements in "
       "place of elements, or leave this key out"},
      {"elements = [20, 10, 4]", "zone_elements = [12, 10]",
       "case.toml:16: mesh.zone_elements: has 2 numbers, not three; write it as in zone_elements = [16, 16, "
       "4]"},
      {"elements = [20, 10, 4]", "zone_elements = [12, 10, 4]\ngrowth = 0.9",
       "case.toml:17: mesh.growth: is 0.9; allowed: 1 to 3"},
      {"elements = [20, 10, 4]", "zone_elements = [12, 10, 4]\nlargest = \"40 mm\"",
       "case.toml:17: mesh.largest: structured mesh: elements of at most 0.04 m; allowed: not below those in "
       "the "
       "zone, 0.05 m"},
      {"layers = 3", "layers = 3\ncut_from_whole = 1",
       "case.toml:14: zone.cut_from_whole: 1 is neither true nor false; write cut_from_whole = true or "
       "cut_from_whole = false"},
      {"layers = 3\n\n[mesh]\nelements = [20, 10, 4]",
       "overlap = \"0.1 m\"\n\n[mesh]\nfile = \"slab.msh\"\nunit = \"mm\"\ngrowth = 1.2",
       "case.toml:18: mesh.growth: has no meaning beside file; the mesh has its elements already; leave this "
       "key "
       "out"},
      {"[20, 10, 4]", "[20, 10]",
       "case.toml:16: mesh.elements: has 2 numbers, not three; write it as in elements = [38, 30, 4]"},
      {"[20, 10, 4]", "[20, 0, 4]", "case.toml:16: mesh.elements: 0 along y; allowed: 1 to 10000"},
      {"elements = [20, 10, 4]", "elements = [20, 10, 4]\nfile = \"slab.msh\"",
       "case.toml:17: mesh.file: stands beside elements; a mesh is even, as in elements = [38, 30, 4], or "
       "grows "
       "away from the zone, as in zone_elements = [16, 16, 4], or comes from a file = \"slab.msh\""},
      {"elements = [20, 10, 4]", "elements = [20, 10, 4]\nunit = \"mm\"",
       "case.toml:17: mesh.unit: is that of a mesh file; leave it out beside elements"},
      {"elements = [20, 10, 4]", "elements = [20, 10, 4]\nyoung_modulus = \"0 GPa\"",
       "case.toml:17: mesh.young_modulus: is 0 Pa; it must be above 0"},
      {"elements = [20, 10, 4]", "elements = [20, 10, 4]\nmodulus = \"shear\"",
       "case.toml:17: mesh.modulus: \"shear\" is no choice here; allowed: flexural, membrane, bulk"},
      {"elements = [20, 10, 4]", "elements = [20, 10, 4]\nyoung_modulus = \"30 GPa\"\nmodulus = \"bulk\"",
       "case.toml:18: mesh.modulus: says which modulus is measured, and young_modulus is given; leave one of "
       "both out"},
      {"elements = [20, 10, 4]", "elements = [20, 10, 4]\npoisson_ratio = 0.5",
       "case.toml:17: mesh.poisson_ratio: is 0.5; allowed: above -1 to below 0.5"},
      {"elements = [20, 10, 4]", "file = \"slab.msh\"\nunit = \"mm\"",
       "case.toml:13: zone.layers: counts the elements of a structured mesh; an overlap with a mesh from a "
       "file has a thickness, as in overlap = \"0.2 m\""},
      {"layers = 3\n\n[mesh]\nelements = [20, 10, 4]",
       "overlap = \"0.4 m\"\n\n[mesh]\nfile = \"slab.msh\"\nunit = \"mm\"",
       "case.toml:13: zone.overlap: two overlaps of 0.4 m leave nothing of the zone's 0.6 m along x; make the "
       "zone larger or the overlap thinner"},
      {"layers = 3\n\n[mesh]\nelements = [20, 10, 4]",
       "overlap = \"0.1 m\"\n\n[mesh]\nfile = \"none.msh\"\nunit = \"mm\"",
       "case.toml:16: mesh.file: there is no file \"none.msh\"; name a file that exists, relative to the case "
       "file"},
      {"layers = 3\n\n[mesh]\nelements = [20, 10, 4]",
       "overlap = \"0.1 m\"\n\n[mesh]\nfile = \"slab.msh\"\nunit = \"cm\"",
       "case.toml:16: mesh.file: the mesh reaches from 0 to 10 m along x; it must be as large as the "
       "structure, from 0 to 1 m"},
      {"layers = 3\n\n[mesh]\nelements = [20, 10, 4]",
       "overlap = \"0.1 m\"\n\n[mesh]\nfile = \"words.msh\"\nunit = \"cm\"",
       "case.toml:16: mesh.file: words.msh: it is no Gmsh mesh; a .msh file begins with $MeshFormat or "
       "$Comments"},
      {"layers = 3\n\n[mesh]\nelements = [20, 10, 4]", "overlap = \"0.1 m\"\n\n[mesh]\nfile = \"slab.msh\"",
       "case.toml: mesh.unit: the key is missing; write the file's unit of length, as in unit = \"mm\""},
      {"interval = 2", "interval = 0",
       "case.toml:19: coupling.interval: 0 is out of range; it must be from 1 to 10000"},
      {"interval = 2", "ties = \"rotations\"",
       "case.toml:19: coupling.ties: \"rotations\" is no choice here; allowed: displacements, "
       "displacements_and_rotations"},
      {"interval = 2", "solve = \"lumped\"\nties = \"displacements_and_rotations\"",
       "case.toml:19: coupling.solve: lumped multipliers cannot tie rotations; take solve = \"consistent\", or "
       "ties = \"displacements\""},
      {"interval = 2", "relaxation_time = \"-1 us\"",
       "case.toml:19: coupling.relaxation_time: is -1e-06 s; it must be 0 (a strict tie) or more"},
      // supports
      {"name = \"left\"\n", "",
       "case.toml: support[1].name: the key is missing; write it as in name = \"...\""},
      {"\"left\"", "\"left side\"",
       "case.toml:22: support[1].name: is no name; letters, digits, _ and - are allowed: it becomes the title "
       "of a column"},
      {"\nlock = [\"z\"]", "\nlock = []",
       "case.toml:25: support[1].lock: locks nothing; name axes, as in lock = [\"z\"]"},
      {"\nlock = [\"z\"]", "\nlock = [\"w\"]",
       "case.toml:25: support[1].lock: \"w\" is no axis; allowed: x, y, z"},
      {"\nlock = [\"z\"]", "", "case.toml: support[1].lock: locks nothing; name axes, as in lock = [\"z\"]"},
      {"low = \"0,0,0 m\"\nhigh = \"0.025,0.5,0.28 m\"", "low = \"1,0,0 m\"\nhigh = \"1.1,0.5,0.28 m\"",
       "case.toml:23: support[1].low: from 1 to 1.1 m along x there is no structure; it reaches from 0 to 1 m"},
      {"\"0.025,0.5,0.28 m\"", "\"0,0.5,0.28 m\"",
       "case.toml:23: support[1].low: the region reaches from 0 to 0 m along x; low must be below high along "
       "each axis"},
      {"\"0.025,0.5,0.28 m\"", "\"0.025,0.5 m\"",
       "case.toml:24: support[1].high: has 2 lengths, not three; write it as in high = \"0.025,2.0,0.28 m\""},
      {"[impactor]",
       "[[support]]\nname = \"left\"\nlow = \"0.9,0,0 m\"\nhigh = \"1,0.5,0.28 m\"\nlock = [\"z\"]\n[impactor]",
       "case.toml:28: support[2].name: \"left\" stands twice; each one needs a name of its own"},
      // impactor
      {"shape = \"box\"", "shape = \"cube\"",
       "case.toml:28: impactor.shape: \"cube\" is no choice here; allowed: box, sphere, cylinder, mesh"},
      {"\"0.1x0.1x0.1 m\"", "\"0.1x0.1 m\"",
       "case.toml:29: impactor.size: has 2 lengths, not three; write it as in size = \"0.3x0.3x0.3 m\""},
      {"\"0.1x0.1x0.1 m\"", "\"0.1x0.1x0 m\"",
       "case.toml:29: impactor.size: the impactor's size is 0 m; it must be positive and finite"},
      {"shape = \"box\"", "shape = \"sphere\"",
       "case.toml:29: impactor.size: a sphere has none; a box has size and lead, a sphere diameter, a cylinder "
       "diameter, length and nose, a mesh file and unit"},
      {"shape = \"box\"\nsize = \"0.1x0.1x0.1 m\"", "shape = \"sphere\"\ndiameter = \"-60 mm\"",
       "case.toml:29: impactor.diameter: is -0.06 m; it must be above 0"},
      {"shape = \"box\"\nsize = \"0.1x0.1x0.1 m\"", "shape = \"cylinder\"\ndiameter = \"60 mm\"",
       "case.toml: impactor.length: the key is missing; write it as in length = \"98.6 mm\""},
      {"shape = \"box\"\nsize = \"0.1x0.1x0.1 m\"",
       "shape = \"cylinder\"\ndiameter = \"60 mm\"\nlength = \"20 mm\"\nnose = \"hemisphere\"",
       "case.toml:30: impactor.length: a length of 0.02 m is less than the nose's radius of 0.03 m; length "
       "counts the hemispherical nose in"},
      {"shape = \"box\"\nsize = \"0.1x0.1x0.1 m\"", "shape = \"mesh\"\nfile = \"none.stl\"\nunit = \"mm\"",
       "case.toml:29: impactor.file: there is no file \"none.stl\"; name a file that exists, relative to the "
       "case file"},
      {"shape = \"box\"\nsize = \"0.1x0.1x0.1 m\"", "shape = \"mesh\"\nfile = \"open.stl\"\nunit = \"mm\"",
       "case.toml:29: impactor.file: open.stl: triangle 4: no other triangle shares one of its edges: the "
       "surface is open there; an impactor needs a closed surface: repair the mesh"},
      {"shape = \"box\"\nsize = \"0.1x0.1x0.1 m\"", "shape = \"mesh\"\nfile = \"rock.stl\"",
       "case.toml: impactor.unit: the key is missing; write the file's unit of length, as in unit = \"mm\""},
      {"shape = \"box\"\nsize = \"0.1x0.1x0.1 m\"", "shape = \"mesh\"\nfile = \"rock.stl\"\nunit = \"kg\"",
       "case.toml:30: impactor.unit: \"kg\" is not a unit of length; write a length as in \"98.6 mm\""},
      {"density = \"2500 kg/m3\"\n", "",
       "case.toml: impactor.density: the key is missing; write density = \"2500 kg/m3\", or mass = \"67.5 "
       "kg\""},
      {"density = \"2500 kg/m3\"\n", "density = \"2500 kg/m3\"\nmass = \"2 kg\"\n",
       "case.toml:30: impactor.density: stands beside mass; give one of both, the other follows from the "
       "shape"},
      {"\"2500 kg/m3\"", "\"0 kg/m3\"", "case.toml:30: impactor.density: is 0 kg/m3; it must be above 0"},
      {"density = \"2500 kg/m3\"", "mass = \"-1 kg\"",
       "case.toml:30: impactor.mass: is -1 kg; it must be above 0"},
      {"speed = \"40 m/s\"\n", "",
       "case.toml: impactor.speed: the key is missing; write it as in speed = \"40 m/s\""},
      {"\"40 m/s\"", "\"0 m/s\"", "case.toml:31: impactor.speed: is 0 m/s; it must be above 0"},
      {"\"40 m/s\"", "40",
       "case.toml:31: impactor.speed: 40 is a bare number, its unit is missing; write the unit too, as in "
       "speed = \"40 m/s\""},
      {"speed = \"40 m/s\"", "speed = \"40 m/s\"\ndirection = [0, 0, 0]",
       "case.toml:32: impactor.direction: is zero, so it points nowhere; write it as in direction = [0, 0, "
       "-1]"},
      {"speed = \"40 m/s\"", "speed = \"40 m/s\"\ndirection = [0, 1]",
       "case.toml:32: impactor.direction: has 2 numbers, not three; write it as in direction = [0, 0, -1]"},
      {"speed = \"40 m/s\"", "speed = \"40 m/s\"\nlead = \"side\"",
       "case.toml:32: impactor.lead: \"side\" is no choice here; allowed: face, edge, corner"},
      {"speed = \"40 m/s\"", "speed = \"40 m/s\"\nturn = { angle = \"10 degree\" }",
       "case.toml: impactor.turn.axis: the key is missing; write it as in axis = [0, 0, 1]"},
      {"speed = \"40 m/s\"", "speed = \"40 m/s\"\nspin = { axis = [0, 0, 1], period = \"0 s\" }",
       "case.toml:32: impactor.spin.period: is 0 s; it must be above 0"},
      {"\"0.5,0.25,0.14 m\"", "\"0.5,0.75,0.14 m\"",
       "case.toml:32: impactor.aim: the impactor passes the zone by 0.2 m; it must meet the zone: only "
       "discrete elements feel it"},
      {"\"0.5,0.25,0.14 m\"", "\"0.1,0.25,0.14 m\"",
       "case.toml:32: impactor.aim: the impactor passes the zone by 0.05 m; it must meet the zone: only "
       "discrete elements feel it"},
      {contact, with_contact("spring = \"hertz\"\nstiffness = \"5e8 N/m\""),
       "case.toml:36: impactor.contact.stiffness: is that of a linear spring; spring = \"hertz\" takes a "
       "modulus"},
      {contact, with_contact("modulus = \"1 GPa\"\nstiffness = \"5e8 N/m\""),
       "case.toml:36: impactor.contact.stiffness: stands beside modulus; give one of both, or neither for the "
       "card's"},
      {contact, with_contact("stiffness = \"1 GPa\""),
       "case.toml:35: impactor.contact.stiffness: \"1 GPa\" is no stiffness; write it as in stiffness = \"5e8 "
       "N/m\""},
      {contact, with_contact("stiffness = \"0 N/m\""),
       "case.toml:35: impactor.contact.stiffness: is 0 N/m; it must be above 0"},
      {contact, with_contact("friction = -0.1"),
       "case.toml:35: impactor.contact.friction: is -0.1; allowed: 0 or more, the angle's tangent"},
      {contact, with_contact("shear_ratio = -1"),
       "case.toml:35: impactor.contact.shear_ratio: is -1; allowed: 0 or more"},
      {contact, with_contact("damping_ratio = 1.5"),
       "case.toml:35: impactor.contact.damping_ratio: is 1.5; allowed: 0 to 1"},
      // probes
      {"\"under\"", "\"\"",
       "case.toml:35: probe[1].name: is no name; letters, digits, _ and - are allowed: it becomes the title of "
       "a column"},
      {"\"0.5,0.25,0 m\"", "\"0.5,0.25,-0.01 m\"",
       "case.toml:36: probe[1].point: z = -0.01 m lies outside the structure; it reaches from 0 to 0.28 m"},
      {"[run]", "[[probe]]\nname = \"under\"\npoint = \"0.5,0.25,0.28 m\"\n[run]",
       "case.toml:39: probe[2].name: \"under\" stands twice; each one needs a name of its own"},
      // run and output
      {"[run]\nduration = \"2 ms\"", "",
       "case.toml: run: the table is missing; write it as [run] with its keys on the lines below"},
      {"duration = \"2 ms\"", "",
       "case.toml: run.duration: the key is missing; write it as in duration = \"20 ms\""},
      {"\"2 ms\"", "\"0 ms\"", "case.toml:39: run.duration: is 0 s; it must be above 0"},
      {"\"2 ms\"", "\"-2 ms\"", "case.toml:39: run.duration: is -0.002 s; it must be above 0"},
      {"\"2 ms\"", "\"2 ms\"\ntime_step_fraction = 1",
       "case.toml:40: run.time_step_fraction: is 1; allowed: above 0 to below 1, of the critical step"},
      {"\"2 ms\"", "\"2 ms\"\ndamping = 1", "case.toml:40: run.damping: is 1; allowed: 0 to below 1"},
      {"\"2 ms\"", "\"2 ms\"\nsamples = 0",
       "case.toml:40: run.samples: 0 is out of range; it must be from 1 to 1000000"},
      {"\"2 ms\"", "\"2 ms\"\n[output]\nframes = -1",
       "case.toml:41: output.frames: -1 is out of range; it must be from 0 to 100000"},
  };
}

}  // namespace scene_refusals
