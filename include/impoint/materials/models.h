#ifndef impoint_materials_models_h
#define impoint_materials_models_h

#include <impoint/materials/elastic_moduli.h>
#include <impoint/materials/material.h>

#include <deal.II/base/patterns.h>

#include <tuple>
#include <vector>

namespace Impoint
{
  namespace Materials
  {
    /** Makes the model of a section of a scene. Throws InputError. */
    template <int dim>
    using ModelMaker =
      std::unique_ptr<Material<dim>> (*)(const ElasticModuli &moduli,
                                         const ParameterFile &file,
                                         const std::string   &section);

    /** What the entry 'Model' may be: a row of the table of materials. Entries,
     * their help texts and messages follow from it. */
    struct Model
    {
      std::string              name;
      std::string              help;
      std::vector<std::string> entries; // those it has beside E and nu

      std::tuple<ModelMaker<2>, ModelMaker<3>> make;
    };

    /** All models, the default first. */
    const std::vector<Model> &models();

    const Model &model(const std::string &name);

    /** An entry that some of the models have. */
    struct ModelEntry
    {
      std::string                                  name, default_value;
      std::shared_ptr<const Patterns::PatternBase> pattern;
      std::string                                  help;

      /** The models that have it. */
      std::vector<std::string> models() const;
    };

    const std::vector<ModelEntry> &model_entries();
  } // namespace Materials
} // namespace Impoint

#endif
