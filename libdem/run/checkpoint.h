// Stop and go on, bit for bit: the state of a run in a file.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "libdem/io/hdf5.h"
#include "libdem/run/step.h"

namespace dem {

/// `open_spall_file` for what a run goes on from: the remedy of its InputError is to start anew.
Hdf5File open_checkpoint(const std::filesystem::path& file, const std::string& format, int version);

/// What the caller keeps besides the assembly, by name: counters, sums, a curve. A single number is a column of
/// one. Names must not hold a '/'.
using NamedNumbers = std::map<std::string, std::vector<double>>;

/// What a checkpoint belongs to: each input's name ("specimen", "card", "options") and its SHA-256. A run goes
/// on only with the same ones.
using Belonging = std::vector<std::pair<std::string, std::string>>;

/// Writes the state after a step: an HDF5 file of format "spall-checkpoint", version 1, with the SHA-256 of its
/// content, whole or not at all. Settles the assembly. Throws RunError if it cannot be written.
///
/// Kept are the columns that a run changes. What follows from the specimen and the card (geometry at rest,
/// masses, the law, which pairs are linked) is not: the reader makes it anew.
void write_checkpoint(const std::filesystem::path& file, const Belonging& belongs_to, Assembly& assembly,
                      const StepRoom& room, const NamedNumbers& numbers);

/// Brings `assembly` and `room`, made anew from the same inputs, to the state of the file, and returns the
/// caller's numbers. The next `advance` gives the bits that it would have given without the stop, on any number
/// of threads, as long as the machine has the same instruction set. Throws InputError, and changes nothing, if
/// the file is no checkpoint, has a newer version, is damaged, or belongs to something else (it says to what).
NamedNumbers read_checkpoint(const std::filesystem::path& file, const Belonging& belongs_to, Assembly& assembly,
                             StepRoom& room);
/// The same of a file that is open.
NamedNumbers read_checkpoint(const Hdf5File& file, const Belonging& belongs_to, Assembly& assembly,
                             StepRoom& room);

}  // namespace dem
