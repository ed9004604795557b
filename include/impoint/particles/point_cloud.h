#ifndef impoint_particles_point_cloud_h
#define impoint_particles_point_cloud_h

#include <impoint/grid/basis.h>
#include <impoint/particles/property_layout.h>

#include <deal.II/particles/property_pool.h>

#include <memory>
#include <string>
#include <vector>

DEAL_II_NAMESPACE_OPEN
namespace Particles
{
  template <int dim, int spacedim>
  class ParticleHandler;
}
DEAL_II_NAMESPACE_CLOSE

namespace Impoint
{
  /**
   * Particles of one kind in the grid's cells, in deal.II's ParticleHandler:
   * their state is its properties. The lists beside it serve to go over the
   * particles cell by cell at full speed. The handler's own sort is never
   * called, as it visits all cells of the grid and is wrong on simplices: the
   * few particles that leave their cell are taken out and put in again. It
   * knows the places at which they came into their cells; where they are now is
   * in data().
   *
   * Particles are numbered 0 ... n() - 1 on this rank: cells increasing, those
   * of a cell by their id. Numbers and data() pointers change whenever a
   * particle changes its cell; id() stays. Nothing outside of this class
   * sorts, moves or counts particles.
   */
  template <int dim>
  class PointCloud
  {
  public:
    /** The particles [begin, end) lie in cell. */
    struct Range
    {
      unsigned int cell, begin, end;
    };

    /** A particle to insert; properties in the order of the layout. */
    struct NewParticle
    {
      unsigned int          cell;
      types::particle_index id;
      std::vector<double>   properties;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &cell &id &properties;
      }
    };

    /**
     * The particle's place must be the first field of @p layout. Supports are
     * those of that place, or of the one in @p anchor, which then never
     * changes: the particle keeps its cell and its support.
     */
    PointCloud(const Basis<dim>     &basis,
               const PropertyLayout &layout,
               const unsigned int    anchor = 0);
    ~PointCloud();
    PointCloud(PointCloud &&) noexcept;

    /** Inserts particles into this rank's own cells. Collective. */
    void insert(const std::vector<NewParticle> &particles);

    unsigned int n() const
    {
      return states.size();
    }
    types::particle_index n_global() const;

    const std::vector<Range> &ranges() const
    {
      return cell_ranges;
    }
    std::vector<unsigned int> cells() const;

    double *data(const unsigned int p)
    {
      return states[p];
    }
    const double *data(const unsigned int p) const
    {
      return states[p];
    }

    /** Asks for the state of the particle that a loop comes to when it is done
     * with a few more after @p p: particles that changed their cells lie
     * anywhere in memory. */
    void prefetch_after(const unsigned int p) const
    {
      constexpr unsigned int ahead = 6, line = 8; // particles, doubles
      if (p + ahead < states.size())
        for (unsigned int i = 0; i < property_layout.n_doubles(); i += line)
          __builtin_prefetch(states[p + ahead] + i);
    }

    types::particle_index id(const unsigned int p) const
    {
      return pool->get_id(handles[p]);
    }

    Point<dim> position(const unsigned int p) const
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = states[p][d];
      return x;
    }

    /** Support of particle @p p (see Basis::evaluate()). */
    const double *support(const unsigned int p) const
    {
      return supports.data() + first_support[p];
    }

    /**
     * Finds the cells of @p new_places, one for each particle, and remembers
     * them for move(). If one of them lies outside of the grid, throws on every
     * rank, with nothing changed: RunFailed, or StepFailed if some particle
     * moves by more than a cell, so that smaller steps may go another way.
     * Messages call a particle a @p kind. Nothing to do for particles with an
     * anchor: returns false. Collective.
     */
    bool find(const std::vector<Point<dim>> &new_places,
              const std::string             &kind);

    /** Renews the supports of a cell's particles ahead of move(), while they
     * are in the cache; unless some particle leaves its cell. */
    void renew_supports(const Range &range);

    /**
     * After the particles' places were set to what find() was asked for: puts
     * those that left their cell into the new one (on other ranks, too) and
     * renews all supports. Returns whether any particle of any rank changed
     * its cell. Collective.
     */
    bool move();

    const PropertyLayout &layout() const
    {
      return property_layout;
    }

    /** How often all supports were evaluated. */
    std::size_t n_evaluations() const
    {
      return evaluations;
    }

  private:
    using Handler = Particles::ParticleHandler<dim, dim>;
    using Pool    = Particles::PropertyPool<dim, dim>;

    /** A particle that changes its cell. */
    struct Move
    {
      unsigned int particle, cell; // cell on the rank it goes to
      unsigned int rank;
    };

    /** A particle that leaves a cell of this rank. */
    struct Departure
    {
      unsigned int          cell;
      typename Pool::Handle handle;
    };

    /** A particle that comes into a cell. */
    struct Arrival
    {
      unsigned int          cell;
      types::particle_index id;
      Point<dim>            reference; // coordinates in the cell
      const double         *state;
      typename Pool::Handle handle; // once it is in
    };

    void   find_strays(const std::vector<Point<dim>>   &new_places,
                       const std::vector<unsigned int> &strays,
                       const std::string               &kind);
    double largest_travel(const std::vector<Point<dim>> &new_places) const;
    void   change_cells();
    void   announce(const std::vector<NewParticle> &particles,
                    std::vector<Arrival>           &arrivals) const;
    void   exchange(const std::vector<Departure> &departures,
                    std::vector<Arrival>         &arrivals);
    void   take_out(const Departure &departure);
    void   put_in(Arrival &arrival);
    void   list(const std::vector<Arrival> &arrivals);
    void   append(const unsigned int          cell,
                  const typename Pool::Handle handle,
                  const Point<dim>           &reference);
    void   place_supports();
    void   evaluate_supports(const Range &range);

    const Basis<dim>                  &basis;
    PropertyLayout                     property_layout;
    unsigned int                       anchor;
    std::size_t                        evaluations = 0;
    unsigned int                       n_renewed   = 0; // ahead of move()
    std::unique_ptr<Handler>           handler;
    Pool                              *pool; // the handler's
    std::vector<Range>                 cell_ranges;
    std::vector<typename Pool::Handle> handles;
    std::vector<double *>              states; // in the pool
    std::vector<Point<dim>>            references;
    std::vector<std::size_t>           first_support;
    std::vector<double>                supports;
    std::vector<Move>                  moves; // of find(), for move()
  };
} // namespace Impoint

#endif
