// Content of VTU and PVD files: what was written is read back, wherever the
// points and cells are. Same output on any number of ranks.

#include <impoint/output/vtu_writer.h>

#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numeric>
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
  std::ifstream      file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/** Number of values of the array @p name in all pieces, and their sum. */
std::string array_sum(const std::string &vtu, const std::string &name)
{
  double      sum = 0;
  std::size_t n = 0, at = 0;
  while ((at = vtu.find("Name=\"" + name + "\"", at)) != std::string::npos)
    {
      at                     = vtu.find(">\n", at) + 2;
      const std::string code = vtu.substr(at, vtu.find('\n', at) - at);
      // 4 numbers of 4 bytes: blocks (1), size, size of the last, compressed
      const auto    head = Utilities::decode_base64(code.substr(0, 24));
      const auto    body = Utilities::decode_base64(code.substr(24));
      std::uint32_t size = 0;
      std::memcpy(&size, head.data() + 4, 4);
      std::vector<float> values(size / sizeof(float));
      uLongf             length = size;
      if (uncompress(reinterpret_cast<Bytef *>(values.data()),
                     &length,
                     body.data(),
                     body.size()) != Z_OK)
        return name + " broken";
      n += values.size();
      sum = std::accumulate(values.begin(), values.end(), sum);
    }
  return name + ": " + std::to_string(n) + " values, sum " +
         std::to_string(sum);
}

void test_points(const OutputFolder &folder)
{
  PointFields<2> points; // all on the last rank
  points.fields = {{"body", 1, {}}, {"velocity", 2, {}}, {"stress", 6, {}}};
  if (Utilities::MPI::this_mpi_process(comm) + 1 ==
      Utilities::MPI::n_mpi_processes(comm))
    points = {{Point<2>(1, 2), Point<2>(3, 4)},
              {{"body", 1, {0, 1}},
               {"velocity", 2, {1, 2, 3, 4}},
               {"stress", 6, {1, 2, 3, 10, 20, 30, 1, 1, 1, 0, 0, 0}}}};
  CollectionWriter<2> writer(folder, "points");
  writer.write(0, points);
  writer.write(0.25, points);
  const std::string vtu = content(folder.path() + "/vtu/points-00001.vtu");
  for (const char *name : {"body", "velocity", "stress"})
    say(array_sum(vtu, name));
  std::istringstream pvd(content(folder.path() + "/points.pvd"));
  for (std::string line; std::getline(pvd, line);)
    if (line.find("<DataSet") != std::string::npos)
      say(line);
}

void test_grid(const OutputFolder &folder)
{
  GridFields<3> grid;
  grid.simplices = true;
  if (is_root())
    grid.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  grid.vertex_fields = {{"u", 1, {}}};
  grid.cell_fields   = {{"active", 1, {}}};
  if (is_root())
    grid.vertex_fields[0].data = {1, 2, 3, 4}, grid.cell_fields[0].data = {5};
  CollectionWriter<3>(folder, "grid").write(1, grid);
  const std::string cells = content(folder.path() + "/vtu/grid-00000.vtu");
  say(array_sum(cells, "u") + "\n" + array_sum(cells, "active"));
}

/** More than MPI takes at once. */
void test_large_pieces()
{
  const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
  const std::size_t  size = (40 << 20) + 1;
  bool               same = true;
  char               next = 'a';
  collect_on_root(std::string(size, 'a' + rank),
                  comm,
                  [&](const std::string &of_rank) {
                    same &= of_rank == std::string(size, next++);
                  });
  say(std::string("large pieces arrive: ") + (same ? "yes" : "no"));
}

int main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const OutputFolder               folder("scratch-vtu", true, comm);
  folder.create();
  test_points(folder);
  test_grid(folder);
  test_large_pieces();

  MPI_Barrier(comm);
  if (is_root())
    std::filesystem::remove_all(folder.path());
  try
    {
      CollectionWriter<2>(folder, "points").write(0, PointFields<2>());
    }
  catch (const RunFailed &error)
    {
      say(error.what());
    }
}
