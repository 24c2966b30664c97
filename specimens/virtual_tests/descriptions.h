// Each test as the catalogue shows it; made beside the test.
#pragma once
#include "specimens/virtual_tests/test_description.h"

namespace virtual_tests {

TestDescription elastic_description();
TestDescription uniaxial_description(Loading loading);
TestDescription splitting_description();
TestDescription bending_description();
TestDescription shear_description();

}  // namespace virtual_tests
