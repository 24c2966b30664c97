// The plan of a study: every test on every specimen at every setting, numbered, named by hash, estimated.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "study/design.h"
#include "study/study_file.h"

namespace study {

/// One virtual test. Tasks of one specimen stand together; their numbers begin at 1.
struct Task {
  std::size_t number = 0;
  std::size_t specimen = 0, card = 0, point = 0, test = 0;  ///< indices into Study and Plan::points
  std::string key;                                          ///< names its result; several tasks may share one
  double seconds = 0;                                       ///< estimated, on one core
  double bytes = 0;                                         ///< of memory, estimated
};

struct Plan {
  Study study;
  std::vector<DesignPoint> points;
  std::vector<dem::MaterialCard> cards;  ///< with the point's values: index card * points.size() + point
  std::vector<Task> tasks;

  const dem::MaterialCard& card_of(const Task& task) const {
    return cards[task.card * points.size() + task.point];
  }
  const SpecimenRecipe& specimen_of(const Task& task) const { return study.specimens[task.specimen]; }
  const VirtualTest& test_of(const Task& task) const { return study.tests[task.test]; }
};

/// Expands a study into its tasks: specimen by specimen, then card, point and test. Throws InputError where a
/// setting makes no valid card (the setting is named), or if there would be more than a million tasks.
Plan make_plan(Study study);

/// Tasks by their numbers, as "1-10, 12"; all of them if `numbers` is empty. `where` begins the InputError for
/// numbers that the plan does not have.
std::vector<std::size_t> choose_tasks(const Plan& plan, const std::string& numbers, const std::string& where);

/// The part of `chosen` that belongs to share `index` (from 0) of `count`: long tasks are dealt out first, so
/// that the shares take about as long as each other. Every process that deals gets the same parts.
std::vector<std::size_t> share_of(const Plan& plan, const std::vector<std::size_t>& chosen, std::size_t index,
                                  std::size_t count);

}  // namespace study
