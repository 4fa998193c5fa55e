// The work on one item: press its mat unless that is done, test the panels, keep the moduli.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/run/form.hpp"
#include "strandlab/run/observer.hpp"
#include "strandlab/run/test.hpp"
#include "strandlab/study/claim.hpp"
#include "strandlab/study/folder.hpp"

namespace strandlab::study {

enum class Keep { kPanels, kModuli };  // kModuli: panels go when all items of their pressing are whole

struct Work {
  int threads = 1;
  Keep keep = Keep::kPanels;
};

// What item.json holds.
struct ItemRecord {
  bool whole = false;                  // all states are tested
  std::string error;                   // why it is not, where it has failed
  std::vector<run::KeptState> states;  // of a whole item
  run::Tested tested;                  // state by state, in order; bit for bit as it was measured
};

// Nothing for an item that nobody has worked on. A file that is damaged reads as an error.
ItemRecord read_record(const Study& study, const Item& item);

// Runs an item, or goes on with one, to the same bits; nothing is done where it is whole. The caller holds the item's
// claim, and may hand over that of its pressing; else the item waits for who is pressing it. A checkpoint or panel
// that cannot be used is told of and made again. Throws InputError or RunError for an item that fails, having recorded
// it, and Cancelled.
void run_item(const Study& study, const Item& item, const Work& work, std::optional<Claim> pressing,
              run::Observer& observer);

// Says in item.json why an item failed; what was tested of it stays.
void record_failure(const Study& study, const Item& item, const std::string& error);
// The same; where the disk takes not even this, the observer is told.
void try_to_record_failure(const Study& study, const Item& item, const std::string& error, run::Observer& observer);

}  // namespace strandlab::study
