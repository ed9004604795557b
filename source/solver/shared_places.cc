#include <impoint/solver/shared_places.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace Impoint
{
  namespace
  {
    using Number = NodeExchange::Number;

    /** The places of each rank meet at one that follows from them. */
    template <int dim>
    class Meeting
    {
    public:
      using Place = std::array<int, dim>;

      Meeting(const MPI_Comm            comm,
              const std::vector<Place> &places,
              const std::vector<char>  &claimed);

      /** What is known of each place where it meets. */
      struct Entry
      {
        unsigned int owner = numbers::invalid_unsigned_int;
        Number       number;
      };

      /** For each of the own places. Collective. */
      std::vector<Number>
      ask(const std::function<Number(const Entry &)> &question) const;

      /** Tells the numbers of the places that this rank owns. Collective. */
      void tell(const std::vector<Number> &numbers);

    private:
      using Numbers = std::map<unsigned int, std::vector<Number>>;

      const MPI_Comm                                    comm;
      std::map<unsigned int, std::vector<unsigned int>> indices; // by rank
      std::map<unsigned int, std::vector<Place>>        guests;  // by rank
      std::map<Place, Entry>                            entries;
    };



    template <int dim>
    Meeting<dim>::Meeting(const MPI_Comm            comm,
                          const std::vector<Place> &places,
                          const std::vector<char>  &claimed)
      : comm(comm)
    {
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
      std::map<unsigned int, std::vector<int>> sent;
      for (unsigned int i = 0; i < places.size(); ++i)
        {
          unsigned int sum = 0;
          for (const int coordinate : places[i])
            sum = 31 * sum + coordinate;
          indices[sum % n_ranks].push_back(i);
          auto &message = sent[sum % n_ranks];
          message.insert(message.end(), places[i].begin(), places[i].end());
          message.push_back(claimed[i]);
        }
      for (const auto &[rank, message] :
           Utilities::MPI::some_to_some(comm, sent))
        for (std::size_t i = 0; i < message.size(); i += dim + 1)
          {
            Place place;
            std::copy_n(message.begin() + i, dim, place.begin());
            guests[rank].push_back(place);
            Entry &entry = entries[place];
            if (message[i + dim])
              entry.owner = std::min(entry.owner, rank);
          }
    }



    template <int dim>
    std::vector<Number> Meeting<dim>::ask(
      const std::function<Number(const Entry &)> &question) const
    {
      Numbers sent;
      for (const auto &[rank, places] : guests)
        for (const Place &place : places)
          sent[rank].push_back(question(entries.at(place)));
      const auto   answers = Utilities::MPI::some_to_some(comm, sent);
      unsigned int n       = 0;
      for (const auto &answer : answers)
        n += answer.second.size();
      std::vector<Number> result(n);
      for (const auto &[rank, answer] : answers)
        for (unsigned int i = 0; i < answer.size(); ++i)
          result[indices.at(rank)[i]] = answer[i];
      return result;
    }



    template <int dim>
    void Meeting<dim>::tell(const std::vector<Number> &numbers)
    {
      Numbers sent;
      for (const auto &[rank, list] : indices)
        for (const unsigned int i : list)
          sent[rank].push_back(numbers[i]);
      for (const auto &[rank, told] : Utilities::MPI::some_to_some(comm, sent))
        for (unsigned int i = 0; i < told.size(); ++i)
          {
            Entry &entry = entries.at(guests.at(rank)[i]);
            if (entry.owner == rank)
              entry.number = told[i];
          }
    }
  } // namespace



  template <int dim>
  SharedPlaces<dim>::SharedPlaces(
    const MPI_Comm                           communicator,
    const std::vector<std::array<int, dim>> &places,
    const std::vector<char>                 &claimed)
  {
    using Entry = typename Meeting<dim>::Entry;
    Meeting<dim>       meeting(communicator, places, claimed);
    const unsigned int me = Utilities::MPI::this_mpi_process(communicator);
    const auto         owners =
      meeting.ask([](const Entry &entry) { return entry.owner; });
    for (unsigned int i = 0; i < places.size(); ++i)
      if (owners[i] == me)
        order.push_back(i);
    n_owned = order.size();

    const Number first = NodeExchange(communicator, n_owned, {}).first_number();
    std::vector<Number> numbers(places.size());
    for (unsigned int i = 0; i < n_owned; ++i)
      numbers[order[i]] = first + i;
    meeting.tell(numbers);
    numbers = meeting.ask([](const Entry &entry) { return entry.number; });

    std::vector<std::pair<Number, unsigned int>> others;
    for (unsigned int i = 0; i < places.size(); ++i)
      if (owners[i] != me)
        others.emplace_back(numbers[i], i);
    std::sort(others.begin(), others.end());
    for (const auto &[number, i] : others)
      {
        ghosts.push_back(number);
        order.push_back(i);
      }
  }

  template struct SharedPlaces<2>;
  template struct SharedPlaces<3>;
} // namespace Impoint
