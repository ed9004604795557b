// Failures of one rank reach all of them, the gravest first; the state's
// archive gives back what it took, and says what does not fit.

#include <impoint/base/exceptions.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/base/state_archive.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <iostream>
#include <vector>

using namespace Impoint;
using namespace dealii;

// "kind: message" of what @p action throws, joined over ranks if they differ.
void attempt(const std::function<void()> &action)
{
  std::string caught = "nothing";
  try
    {
      on_all_ranks(MPI_COMM_WORLD, action);
    }
  catch (const InputError &error)
    {
      caught = std::string("input error: ") + error.what();
    }
  catch (const RunFailed &error)
    {
      caught = std::string("run failed: ") + error.what();
    }
  catch (const StepFailed &error)
    {
      caught = std::string("step failed: ") + error.what();
    }
  const auto all  = Utilities::MPI::all_gather(MPI_COMM_WORLD, caught);
  bool       same = true;
  for (const auto &of_rank : all)
    same = same && of_rank == all[0];
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << all[0] << (same ? "" : ", but not on all ranks") << std::endl;
}

void failures()
{
  const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const bool last = rank + 1 == Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  attempt([]() {});
  attempt([&]() {
    if (last)
      throw StepFailed("on the last rank");
  });
  attempt([&]() {
    if (last)
      throw RunFailed("graver");
    throw StepFailed("on the others");
  });
  attempt([&]() {
    if (last)
      throw InputError("a value", "an entry", "Set another.");
    throw RunFailed("on the others");
  });
  attempt([&]() { throw RunFailed("on all, first " + std::to_string(rank)); });
}

// Of all kinds that an archive takes.
struct Kept
{
  double                                      number = 0;
  unsigned int                                count  = 0;
  std::string                                 text;
  Point<3>                                    place;
  std::vector<double>                         list;
  std::vector<std::pair<double, std::string>> files;

  void save_or_load(StateArchive &archive)
  {
    archive.tag("kept");
    archive &number &count &text &place &list &files;
  }
};

void archives()
{
  Kept         kept{1. / 3, 7, "a\nb", {1, 2, 3}, {4, 5}, {{6, "x"}, {7, ""}}};
  StateArchive written;
  kept.save_or_load(written);
  Kept         read;
  StateArchive again(written.bytes());
  read.save_or_load(again);
  std::cout << "the same: "
            << (read.number == kept.number && read.count == kept.count &&
                read.text == kept.text && read.place == kept.place &&
                read.list == kept.list && read.files == kept.files)
            << std::endl;

  for (const auto &bytes :
       {written.bytes().substr(0, written.bytes().size() - 3),
        "1234567" + written.bytes(),
        StateArchive().bytes()})
    try
      {
        StateArchive wrong(bytes);
        read.save_or_load(wrong);
        std::cout << "read without a complaint" << std::endl;
      }
    catch (const InputError &error)
      {
        std::cout << error.what() << std::endl;
      }
  StateArchive other;
  other.tag("else");
  try
    {
      StateArchive wrong(other.bytes());
      read.save_or_load(wrong);
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  failures();
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    archives();
}
