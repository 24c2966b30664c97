#include "study/specimen_store.h"

#include <filesystem>

#include "libdem/core/error.h"
#include "specimens/packing.h"
#include "specimens/specimen_file.h"
#include "study/plan_key.h"

namespace study {
namespace {

using specimens::Specimen;
using Shared = std::shared_ptr<const Specimen>;

/// Gives the claim back whatever happens.
struct Claim {
  Claims& claims;
  const std::string& key;
  ~Claim() { claims.release(key); }
};

Shared from_users_file(const SpecimenRecipe& recipe) {
  Specimen specimen = specimens::read_specimen(recipe.file);
  if (specimen.sha256() != recipe.sha256)
    throw dem::InputError(recipe.file.string(), "holds another specimen than when the study was read",
                          "leave the files of a study as they are while it runs");
  return std::make_shared<const Specimen>(std::move(specimen));
}

}  // namespace

SpecimenStore::Entry& SpecimenStore::entry(const std::string& key) {
  const std::scoped_lock lock(mutex);
  return entries[key];
}

Shared SpecimenStore::stored(const std::string& key) const {
  const std::filesystem::path file = folder.specimen(key);
  if (!std::filesystem::exists(file)) return nullptr;
  try {
    return std::make_shared<const Specimen>(specimens::read_specimen(file));
  } catch (const dem::InputError&) {
    return nullptr;  // damaged: it is packed again
  }
}

Shared SpecimenStore::make(const SpecimenRecipe& recipe, const std::string& key) {
  if (Shared found = stored(key)) return found;
  if (!claims.take(key)) return nullptr;
  const Claim claim{claims, key};
  if (Shared found = stored(key)) return found;  // another process was quicker
  specimens::PackingOptions packing = recipe.packing;
  packing.threads = 1;
  auto packed = std::make_shared<const Specimen>(specimens::make_specimen(packing));
  specimens::write_specimen(folder.specimen(key), *packed);
  return packed;
}

Shared SpecimenStore::get(const SpecimenRecipe& recipe) {
  const std::string key = key_of(recipe);
  Entry& known = entry(key);
  const std::scoped_lock lock(known.mutex);
  if (Shared held = known.specimen.lock()) return held;
  if (known.failure) std::rethrow_exception(known.failure);
  try {
    Shared found = recipe.file.empty() ? make(recipe, key) : from_users_file(recipe);
    known.specimen = found;
    return found;
  } catch (const dem::Interrupted&) {
    throw;
  } catch (...) {
    known.failure = std::current_exception();
    throw;
  }
}

}  // namespace study
