// From a table of double-lap-shear specimens to glue compliances per specimen, per group, and between groups.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/bondline/record.hpp"
#include "strandlab/bondline/shear_lag.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/statistics/statistics.hpp"

namespace strandlab::bondline {

struct Specimen {
  std::string id, group;
  std::string source;  // "dls.csv:12"
  Geometry geometry;
  std::optional<double> k_N_per_mm;        // measured stiffness
  std::optional<double> k_error_N_per_mm;  // its standard uncertainty, where the table or the record gives one
  std::optional<Slope> slope;              // where k comes from a record
  std::string problem;                     // why it cannot be evaluated (a missing value...), empty if it can
  std::vector<std::string> factors;        // cells of the further columns, in the order of SpecimenTable::factors
};

struct SpecimenTable {
  std::vector<std::string> factors;  // names of the further columns
  std::vector<Specimen> specimens;   // in the order of the file
};

// Reads specimens: id, group, E1, E2, t1, t2, W, l, L1, L2, k (units in the header), optional G1, G2 and u_k, the
// standard uncertainty of k; further columns are kept. With `records`, k comes from the file that column "record" names
// in that folder, else <id>.csv. An empty cell excludes its specimen with the reason. Throws InputError as Table does,
// for sizes and moduli that are not positive, for two specimens of one name in one group, and for a record that cannot
// be read.
struct Records {
  std::filesystem::path folder;
  LoadWindow window;
};
SpecimenTable read_specimens(const std::filesystem::path& file, const std::optional<Records>& records = std::nullopt);

struct Options {
  Formula formula = Formula::kCoth;
  Uncertainty uncertainty;
  std::vector<std::string> group_by{"group"};  // columns whose values make up a group
  std::vector<std::string> within;             // columns that part the groups: compared only within
};

struct Evaluated {
  Specimen specimen;
  std::string group;                   // values of Options::within and group_by
  std::string family;                  // by Options::within; empty without
  std::optional<double> compliance_t;  // 1/D_t, mm/MPa; none where excluded
  std::string excluded;                // the reason, in a plain sentence
  Propagated uncertainty;              // where there is a compliance
  double ratio = 0, sensitivity = 0;   // C/C_inf and d ln k / d ln(1/D_t), likewise
};

struct Group {
  std::string name, family;
  int excluded = 0;
  statistics::Summary compliance_t;          // mm/MPa, of the specimens not excluded
  int n_mean_k = 0;                          // specimens with a stiffness, excluded ones too
  double mean_k_N_per_mm = 0;                // NaN without any
  Geometry mean_geometry;                    // of those specimens
  std::optional<double> compliance_of_mean;  // 1/D_t of the mean stiffness with the mean geometry, mm/MPa
};

// Groups compared with each other. Comparisons that the data do not allow are left out and `note` says why.
struct Family {
  std::string name;
  std::vector<int> groups;  // indices into Analysis::groups, those with two values or more
  std::optional<statistics::Anova> anova;
  std::optional<statistics::WelchAnova> welch;
  std::vector<statistics::Pair> pairs;  // indices into `groups` above
  std::string note;
};

struct Analysis {
  Options options;
  std::vector<std::string> factors;
  std::vector<Evaluated> specimens;
  std::vector<Group> groups;  // in order of first appearance
  std::vector<Family> families;
};

// Throws InputError for a grouping column that the table does not have.
Analysis analyse(const SpecimenTable& table, const Options& options);

// The analysis as JSON text, with units in the keys. group_compliance() reads it back.
std::string to_json(const Analysis& analysis, const std::string& input);

// A group that a result does not have, or has without a value.
struct NoSuchGroup : InputError {
  using InputError::InputError;
};

// Mean 1/D_t (mm/MPa) of a group from a JSON file written by to_json(). Throws InputError for a file that is not one,
// NoSuchGroup for an unknown group (with the groups it has) or one without a value.
double group_compliance(const std::filesystem::path& file, const std::string& group);

}  // namespace strandlab::bondline
