// Subcommands of the program: each adds itself to the command line and does its work when it is called.
#pragma once

namespace CLI {
class App;
}

namespace strandlab::app {

void add_init(CLI::App& app);
void add_check(CLI::App& app);
void add_mat(CLI::App& app);
void add_form(CLI::App& app);
void add_press(CLI::App& app);
void add_test(CLI::App& app);
void add_run(CLI::App& app);
void add_theory(CLI::App& app);
void add_bondline(CLI::App& app);
void add_hotpress(CLI::App& app);
void add_profile(CLI::App& app);
void add_report(CLI::App& app);
void add_figures(CLI::App& app);
void add_movie(CLI::App& app);
void add_study(CLI::App& app);
void add_compare(CLI::App& app);
void add_bench(CLI::App& app);
void add_doctor(CLI::App& app);

}  // namespace strandlab::app
