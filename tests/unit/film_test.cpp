// A virtual test in pictures: how many, which, and what they show.
#include "specimens/virtual_tests/film.h"

#include <gmock/gmock.h>

#include "libdem/core/error.h"
#include "libdem/material/material_card.h"

using testing::ElementsAre;
using virtual_tests::Film;

namespace {

/// Three elements in a row, two links.
dem::Assembly row_of_three() {
  const std::vector<dem::Vec3> centres = {{0, 0, 0}, {0.02, 0, 0}, {0.04, 0, 0}};
  const std::vector<double> radii = {0.01, 0.01, 0.01};
  const std::vector<dem::LinkGeometry> pairs = {{0, 1, 0.02}, {1, 2, 0.02}};
  dem::Assembly assembly;
  assembly.particles = dem::Particles(centres, radii, 0.03);
  assembly.links = dem::make_links(pairs, radii);
  assembly.law = dem::make_link_law(dem::MaterialCard{});
  return assembly;
}

/// Lets `film` see moments 0 to count - 1; link 1 breaks at moment `breaks`, element 2 moves a millimetre a
/// moment.
void watch(Film& film, dem::Assembly& assembly, int from, int count, int breaks) {
  for (int k = from; k < from + count; ++k) {
    if (k == breaks) assembly.links.max_strain[1] = 2 * assembly.law.breaking_strain();
    assembly.particles.kinematics[2].x = 0.04 + 1e-3 * k;
    if (film.is_due()) film.take(assembly, 0.1 * k, k, 2 * k);
  }
}

std::vector<double> controls(const Film& film) {
  std::vector<double> list;
  for (const auto& picture : film.pictures()) list.push_back(picture.control);
  return list;
}

}  // namespace

TEST(Film, TakesNothingUnlessPicturesAreWanted) {
  Film film;
  dem::Assembly assembly = row_of_three();
  watch(film, assembly, 0, 10, 5);
  film.take(assembly, 1, 1, 1);
  EXPECT_TRUE(film.pictures().empty());
}

TEST(Film, KeepsBetweenTheWantedNumberAndTwiceThatEvenly) {
  Film film(4);
  dem::Assembly assembly = row_of_three();
  watch(film, assembly, 0, 8, 1000);
  EXPECT_THAT(controls(film), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  watch(film, assembly, 8, 1, 1000);
  EXPECT_THAT(controls(film), ElementsAre(0, 2, 4, 6, 8));
  watch(film, assembly, 9, 91, 1000);
  const std::vector<double> kept = controls(film);
  EXPECT_THAT(kept, ElementsAre(0, 16, 32, 48, 64, 80, 96));
  // The end is kept, wherever it falls, once.
  film.take(assembly, 9.9, 99, 198);
  film.take(assembly, 9.9, 99, 198);
  EXPECT_EQ(film.pictures().size(), kept.size() + 1);
  EXPECT_EQ(film.pictures().back().stress, 198);
}

TEST(Film, ShowsDisplacementDamageAndWhenALinkBroke) {
  Film film(4);
  dem::Assembly assembly = row_of_three();
  watch(film, assembly, 0, 20, 9);
  EXPECT_THAT(controls(film), ElementsAre(0, 4, 8, 12, 16));
  EXPECT_THAT(film.first_broken(), ElementsAre(-1, 3));
  EXPECT_THAT(film.pictures()[2].damage, ElementsAre(0, 0, 0));
  EXPECT_THAT(film.pictures()[3].damage, ElementsAre(0, 0.5f, 1));
  EXPECT_NEAR(film.pictures()[3].displacement[6], 12e-3, 1e-8);
}

TEST(Film, GoesOnFromACheckpointAsIfNothingHadHappened) {
  Film whole(4), first(4), second(4);
  dem::Assembly a = row_of_three(), b = row_of_three();
  watch(whole, a, 0, 40, 13);
  watch(first, b, 0, 17, 13);
  dem::NamedNumbers numbers;
  first.keep_in(numbers);
  second.restore(numbers, "checkpoint.h5");
  watch(second, b, 17, 23, 13);
  EXPECT_EQ(controls(second), controls(whole));
  EXPECT_EQ(second.first_broken(), whole.first_broken());
  for (std::size_t k = 0; k < whole.pictures().size(); ++k) {
    EXPECT_EQ(second.pictures()[k].displacement, whole.pictures()[k].displacement);
    EXPECT_EQ(second.pictures()[k].damage, whole.pictures()[k].damage);
  }
  numbers["film_damage"].pop_back();
  EXPECT_THROW(second.restore(numbers, "checkpoint.h5"), dem::InputError);
}

TEST(Film, RefusesACheckpointThatLacksThePicturesOfTheBeginning) {
  Film wanted(4), taken(4), unwanted(0);
  EXPECT_THROW(wanted.restore({}, "checkpoint.h5"), dem::InputError);
  dem::Assembly a = row_of_three();
  watch(taken, a, 0, 17, 13);
  dem::NamedNumbers numbers;
  taken.keep_in(numbers);
  EXPECT_NO_THROW(unwanted.restore(numbers, "checkpoint.h5"));
  EXPECT_TRUE(unwanted.pictures().empty());
}
