#include <impoint/solver/node_exchange.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace Impoint
{
  namespace
  {
    constexpr int update_tag = 4711, collect_tag = 4712;

    void wait(std::vector<MPI_Request> &requests)
    {
      const int status =
        MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
      AssertThrowMPI(status);
    }
  } // namespace



  NodeExchange::NodeExchange(const MPI_Comm             communicator,
                             const unsigned int         n_owned,
                             const std::vector<Number> &ghosts)
    : comm(communicator)
    , several(Utilities::MPI::n_mpi_processes(comm) > 1)
    , n_owned(n_owned)
    , ghosts(ghosts)
  {
    const auto          counts = Utilities::MPI::all_gather(comm, n_owned);
    std::vector<Number> firsts(1, 0);
    for (const unsigned int count : counts)
      firsts.push_back(firsts.back() + count);
    first = firsts[Utilities::MPI::this_mpi_process(comm)];

    std::map<unsigned int, std::vector<Number>> wanted;
    for (unsigned int rank = 0, i = 0; i < ghosts.size(); ++rank)
      {
        const unsigned int begin = i;
        while (i < ghosts.size() && ghosts[i] < firsts[rank + 1])
          wanted[rank].push_back(ghosts[i++]);
        if (i > begin)
          segments.push_back({rank, begin, i});
      }
    for (const auto &[rank, numbers] :
         Utilities::MPI::some_to_some(comm, wanted))
      {
        receivers.push_back({rank, {}});
        for (const Number number : numbers)
          receivers.back().nodes.push_back(number - first);
      }
  }



  void NodeExchange::update(std::vector<double> &values) const
  {
    if (segments.empty() && receivers.empty())
      return;
    const std::size_t        width = values.size() / (n_owned + ghosts.size());
    std::vector<MPI_Request> requests(segments.size() + receivers.size());
    auto                     request = requests.begin();
    for (const Segment &it : segments)
      MPI_Irecv(values.data() + (n_owned + it.begin) * width,
                (it.end - it.begin) * width,
                MPI_DOUBLE,
                it.rank,
                update_tag,
                comm,
                &*request++);
    std::vector<std::vector<double>> sent(receivers.size());
    for (unsigned int k = 0; k < receivers.size(); ++k)
      {
        for (const unsigned int node : receivers[k].nodes)
          sent[k].insert(sent[k].end(),
                         values.begin() + node * width,
                         values.begin() + (node + 1) * width);
        MPI_Isend(sent[k].data(),
                  sent[k].size(),
                  MPI_DOUBLE,
                  receivers[k].rank,
                  update_tag,
                  comm,
                  &*request++);
      }
    wait(requests);
  }



  void NodeExchange::share(std::vector<char> &marks) const
  {
    std::vector<double> values(marks.begin(), marks.end());
    update(values);
    marks.assign(values.begin(), values.end());
  }



  void NodeExchange::collect(
    const std::function<void(const double, double &)> &combine,
    std::vector<double>                               &values) const
  {
    if (segments.empty() && receivers.empty())
      return;
    const std::size_t        width = values.size() / (n_owned + ghosts.size());
    std::vector<MPI_Request> requests(segments.size() + receivers.size());
    auto                     request = requests.begin();
    std::vector<std::vector<double>> received;
    for (const Receiver &it : receivers)
      {
        received.emplace_back(it.nodes.size() * width);
        MPI_Irecv(received.back().data(),
                  received.back().size(),
                  MPI_DOUBLE,
                  it.rank,
                  collect_tag,
                  comm,
                  &*request++);
      }
    for (const Segment &it : segments)
      MPI_Isend(values.data() + (n_owned + it.begin) * width,
                (it.end - it.begin) * width,
                MPI_DOUBLE,
                it.rank,
                collect_tag,
                comm,
                &*request++);
    wait(requests);
    for (unsigned int k = 0; k < receivers.size(); ++k)
      for (std::size_t i = 0; i < receivers[k].nodes.size(); ++i)
        for (std::size_t w = 0; w < width; ++w)
          combine(received[k][i * width + w],
                  values[receivers[k].nodes[i] * width + w]);
    std::fill(values.begin() + n_owned * width, values.end(), 0.);
  }



  void NodeExchange::add(std::vector<double> &values) const
  {
    collect([](const double ghost, double &own) { own += ghost; }, values);
  }



  void NodeExchange::keep_largest(std::vector<double> &values) const
  {
    collect([](const double ghost, double &own) { own = std::max(own, ghost); },
            values);
  }



  NodeExchange NodeExchange::select(const std::vector<char> &marks) const
  {
    if (alone())
      return {};
    const unsigned int n_kept =
      std::count(marks.begin(), marks.begin() + n_owned, true);
    Number       next  = 0;
    const Number count = n_kept;
    MPI_Exscan(&count, &next, 1, DEAL_II_DOF_INDEX_MPI_TYPE, MPI_SUM, comm);

    std::vector<double> numbers(n_owned + ghosts.size());
    for (unsigned int i = 0; i < n_owned; ++i)
      if (marks[i])
        numbers[i] = next++;
    update(numbers);
    std::vector<Number> kept;
    for (std::size_t i = n_owned; i < numbers.size(); ++i)
      if (marks[i])
        kept.push_back(static_cast<Number>(numbers[i]));
    return NodeExchange(comm, n_kept, kept);
  }
} // namespace Impoint
