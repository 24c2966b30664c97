// The specimens of a study, each packed once and kept in a file.
#pragma once
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "specimens/specimen.h"
#include "study/claims.h"
#include "study/folder.h"
#include "study/study_file.h"

namespace study {

/// May be used from several threads.
class SpecimenStore {
 public:
  /// Both must outlive the store.
  SpecimenStore(const StudyFolder& where, Claims& whose) : folder(where), claims(whose) {}

  /// The specimen: from memory while somebody holds it, from its file, or packed now on one thread and written.
  /// Null if another process is packing it at this moment. Throws what packing throws, and InputError if a
  /// file of the study has changed since the plan was made.
  std::shared_ptr<const specimens::Specimen> get(const SpecimenRecipe& recipe);

 private:
  struct Entry {
    std::mutex mutex;  // held while it is read or packed
    std::weak_ptr<const specimens::Specimen> specimen;
    std::exception_ptr failure;  // a packing that failed is not tried again
  };
  Entry& entry(const std::string& key);
  /// Null if there is none.
  std::shared_ptr<const specimens::Specimen> stored(const std::string& key) const;
  std::shared_ptr<const specimens::Specimen> make(const SpecimenRecipe& recipe, const std::string& key);

  const StudyFolder& folder;
  Claims& claims;
  std::mutex mutex;  // of the map
  std::map<std::string, Entry> entries;
};

}  // namespace study
