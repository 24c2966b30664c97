// The verbs of the command, one file each. An add_ function declares the verb's options; what it does runs
// later.
#pragma once
#include "app/command.h"

namespace app {

void add_specimen(CLI::App& root, Invocation& invocation);
void add_test(CLI::App& root, Invocation& invocation);
void add_calibrate(CLI::App& root, Invocation& invocation);
void add_impact(CLI::App& root, Invocation& invocation);
void add_card(CLI::App& root, Invocation& invocation);
void add_study(CLI::App& root, Invocation& invocation);
void add_report(CLI::App& root, Invocation& invocation);

}  // namespace app
