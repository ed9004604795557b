// What a run leaves in its folder: refusal of folders, digits of the history,
// names of the summary. Same output on any number of ranks.

#include <impoint/base/exceptions.h>
#include <impoint/output/history.h>
#include <impoint/output/summary.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace Impoint;
const MPI_Comm comm = MPI_COMM_WORLD;

bool is_root()
{
  return Utilities::MPI::this_mpi_process(comm) == 0;
}

void say(const std::string &text)
{
  if (is_root())
    std::cout << text << std::endl;
}

std::string content(const std::string &path)
{
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void check_folder(const std::string &path, const bool overwrite = false)
{
  unsigned int refused = 0;
  std::string  message = "accepted '" + path + "'";
  try
    {
      OutputFolder(path, overwrite, comm, "entry 'Folder'").check();
    }
  catch (const InputError &error)
    {
      refused = 1;
      message = error.what();
    }
  refused = Utilities::MPI::sum(refused, comm);
  if (refused == 0 || refused == Utilities::MPI::n_mpi_processes(comm))
    say(message);
}

void test_history(const OutputFolder &folder)
{
  const double  third = 1. / 3.;
  HistoryWriter history(folder);
  history.begin({"step", "x, y"});
  history.write({{"step", 1}, {"x, y", third}});
  history.write({{"step", 2}, {"x, y", -1e-300 / 7}});
  std::istringstream lines(content(folder.path() + "/history.csv"));
  std::string        header, first, second;
  std::getline(lines, header) && std::getline(lines, first) &&
    std::getline(lines, second);
  const bool exact = std::stod(first.substr(2)) == third &&
                     std::stod(second.substr(2)) == -1e-300 / 7;
  say(header + "\ndigits survive: " + (exact ? "yes" : "no"));
}

void test_summary(const OutputFolder &folder)
{
  RunRecord record;
  record.status     = "failed";
  record.message    = "Step 3: \"det F\" <= 0";
  record.boundaries = {{"clamp", "projected penalty"}};
  record.results    = {{"tip", -2, -2.5}, {"rest", 3, 0}, {"free", 4}};
  record.warnings   = {"a wall in the air"};
  record.counters   = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  record.seconds    = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  record.points     = 14;
  write_summary(record, folder);
  auto json =
    nlohmann::ordered_json::parse(content(folder.path() + "/summary.json"));
  json.erase("version");
  for (const auto &item : json.items())
    say(item.key() + ": " + item.value().dump());
}

/** What one rank cannot write must end all of them. */
void test_lost_folder(const OutputFolder &folder)
{
  if (is_root())
    std::filesystem::remove_all(folder.path());
  unsigned int failed = 0;
  try
    {
      folder.write("summary.json", "");
    }
  catch (const RunFailed &error)
    {
      ++failed;
      say(error.what());
    }
  try
    {
      HistoryWriter(folder).begin({"step"});
    }
  catch (const RunFailed &)
    {
      ++failed;
    }
  failed = Utilities::MPI::sum(failed, comm);
  if (failed == 2 * Utilities::MPI::n_mpi_processes(comm))
    say("failed on all ranks");
}

int main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                path = "scratch/results";
  if (is_root())
    std::filesystem::remove_all("scratch");
  MPI_Barrier(comm);
  check_folder(path);
  const OutputFolder folder(path, true, comm);
  say(std::filesystem::exists("scratch") ? "written" : "nothing written");
  MPI_Barrier(comm);
  folder.create();
  check_folder(path);
  test_history(folder);
  test_summary(folder);
  if (is_root())
    std::filesystem::create_directories(path + "/vtu/mine-00001.vtu");
  for (const char *name : {"mine.txt", "grid.pvd", "vtu/points-00001.vtu"})
    folder.write(name, "of the earlier run");
  check_folder(path);
  check_folder(path, true);
  check_folder(path + "/mine.txt/below");
  check_folder("");
  folder.create();
  for (const char *name : {"mine.txt",
                           "vtu/mine-00001.vtu",
                           "history.csv",
                           "summary.json",
                           "grid.pvd",
                           "vtu/points-00001.vtu"})
    say(name + std::string(std::filesystem::exists(path + "/" + name) ?
                             " stays" :
                             " is removed"));
  test_lost_folder(folder);
}
