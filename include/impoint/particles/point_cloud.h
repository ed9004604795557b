#ifndef impoint_particles_point_cloud_h
#define impoint_particles_point_cloud_h

#include <impoint/grid/basis.h>
#include <impoint/particles/property_layout.h>

#include <deal.II/particles/property_pool.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /**
   * Particles of one kind in the grid's cells. Their state lies in deal.II's
   * pool of properties, as that of a Particles::ParticleHandler does; the lists
   * beside it serve to go over the particles cell by cell at full speed, and
   * to put the few that leave their cell into another one without a look at
   * the rest of the grid.
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
    types::particle_index n_global() const
    {
      return n_of_all_ranks;
    }

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
     * them for move(). Throws StepFailed on every rank, with nothing changed,
     * if one of them lies outside of the grid. Nothing to do for particles
     * with an anchor: returns false. Collective.
     */
    bool find(const std::vector<Point<dim>> &new_places);

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
    using Pool = Particles::PropertyPool<dim>;

    /** A particle that changes its cell. */
    struct Move
    {
      unsigned int particle, cell; // cell on the rank it goes to
      unsigned int rank;
    };

    /** A particle of the pool that comes into a cell. */
    struct Arrival
    {
      unsigned int          cell;
      types::particle_index id;
      typename Pool::Handle handle;
      Point<dim>            reference; // coordinates in the cell
    };

    void find_strays(const std::vector<Point<dim>>   &new_places,
                     const std::vector<unsigned int> &strays);
    void change_cells();
    void take_in(const std::vector<NewParticle> &particles,
                 std::vector<Arrival>           &arrivals);
    void list(std::vector<Arrival> arrivals);
    void append(const unsigned int          cell,
                const typename Pool::Handle handle,
                const Point<dim>           &reference);
    void place_states(const std::size_t n_new);
    void evaluate_supports();

    const Basis<dim>                  &basis;
    PropertyLayout                     property_layout;
    unsigned int                       anchor;
    std::size_t                        evaluations = 0;
    std::unique_ptr<Pool>              pool;
    types::particle_index              n_of_all_ranks = 0;
    std::vector<Range>                 cell_ranges;
    std::vector<typename Pool::Handle> handles;
    std::vector<double *>              states; // in the pool
    std::vector<Point<dim>>            references;
    std::vector<std::size_t>           first_support;
    std::vector<double>                supports;
    std::vector<Move>                  moves;          // of find(), for move()
    std::size_t                        n_unsorted = 0; // in memory
  };
} // namespace Impoint

#endif
