#include "grow_plant.h"

#include <utility>

#include "coupling/plants/plant_organs.h"

quasimc::ModuleString GrownPlant::string(bool with_homomorphism) const {
    return with_homomorphism ? plant_->homomorphic_image() : plant_->string();
}

quasimc::Bounds GrownPlant::bounds() {
    if (view_->box) {
        return *view_->box;
    }
    (void)scene();
    return plant_->bounds();
}

const std::shared_ptr<const quasimc::Scene>& GrownPlant::scene() {
    if (is_drawn_) {
        return scene_;
    }
    quasimc::MeshDrawing drawing(view_->contour_sides);
    plant_->draw(drawing);
    if (auto drawn = quasimc::drawn_plant_scene(drawing, step())) {
        scene_ = std::make_shared<const quasimc::Scene>(std::move(*drawn));
    }
    is_drawn_ = true;
    return scene_;
}
