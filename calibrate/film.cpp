#include "calibrate/film.h"

#include <array>

#include "calibrate/specimen_set.h"
#include "libdem/core/parallel.h"
#include "specimens/virtual_tests/catalogue.h"

namespace calibrate {

FilmedTests film_tests(const CalibrationCase& wanted, const dem::MaterialCard& card, int pictures, int threads,
                       const dem::ProgressCallback& progress) {
  if (progress) progress({"pictures", 0, 0, "tests", "the first specimen, pulled and pushed"});
  CalibrationCase uniaxial = wanted;
  uniaxial.laboratory.clear();
  const auto first = [](const auto& list) {
    return std::remove_cvref_t<decltype(list)>(list.begin(), list.begin() + (list.empty() ? 0 : 1));
  };
  SpecimenSet set = make_set(uniaxial, first(wanted.fit_seeds), first(wanted.fit_centres), threads);
  FilmedTests filmed;
  filmed.specimen = std::move(set.specimens.front());
  filmed.label = std::move(set.labels.front());
  TestProtocol protocol = protocol_for(wanted);
  const std::array asked{&protocol.tension, &protocol.compression};
  const std::array outcomes{&filmed.tension, &filmed.compression};
  dem::for_each_in_parallel(asked.size(), threads, [&](std::size_t k) {
    asked[k]->stop_at = 0;  // the usual end: well down the softening branch
    *outcomes[k] = virtual_tests::run_test(filmed.specimen, card, *asked[k], {}, {.pictures = pictures});
  });
  return filmed;
}

}  // namespace calibrate
