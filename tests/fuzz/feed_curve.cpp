#include "calibrate/lab/csv.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_folder.h"

// Every column is read as numbers: whatever a case may name.
void fuzz::curve(std::string_view bytes) {
  take_refusal([&] {
    const lab::CsvTable table = lab::parse_csv(std::string(bytes), "curve.csv");
    lab::find_column(table, table.columns.front().name);
    for (std::size_t column = 0; column < table.columns.size(); ++column) lab::numbers(table, column);
  });
}
