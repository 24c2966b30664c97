// Each test as the catalogue shows it; made beside the test.
#pragma once
#include "specimens/virtual_tests/test_description.h"

namespace virtual_tests {

TestDescription elastic_description();
TestDescription uniaxial_description(Loading loading);
TestDescription splitting_description();
TestDescription bending_description();
TestDescription shear_description();
TestDescription triaxial_description();
TestDescription biaxial_description();
TestDescription cyclic_description();
TestDescription spalling_description();

}  // namespace virtual_tests
