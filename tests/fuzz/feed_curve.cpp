#include "calibrate/lab/csv.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_file.h"

// Every column is read as numbers: whatever a case may name.
void fuzz::curve(std::string_view bytes) {
  read_as_file("curve.csv", bytes, [](const auto& file) {
    const lab::CsvTable table = lab::read_csv(file);
    lab::find_column(table, table.columns.front().name);
    for (std::size_t column = 0; column < table.columns.size(); ++column) lab::numbers(table, column);
  });
}
