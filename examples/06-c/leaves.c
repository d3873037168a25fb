/* Two leaves, one half above the other, over soil, under sun and sky: the light that each absorbs. */

#include <stdio.h>
#include <stdlib.h>

#include <quasimc/capi.h>

/* Ends the program if a call failed. */
static void check(int status) {
    if (status != QUASIMC_DONE) {
        fprintf(stderr, "%s\n", quasimc_last_error());
        exit(status);
    }
}

static void add_leaves(quasimc_scene* scene) {
    /* x, y, z of each corner; three numbers of corners for each triangle; the leaf of each. */
    const double vertices[] = {0, 0, 0.2, 0.1, 0, 0.2, 0.1, 0.1, 0.2, 0, 0.1, 0.2,
                               0.05, 0, 0.3, 0.15, 0, 0.3, 0.15, 0.1, 0.3, 0.05, 0.1, 0.3};
    const int32_t faces[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    const int64_t organs[] = {1, 1, 2, 2};
    check(quasimc_scene_add_mesh(scene, vertices, 8, faces, 4, organs, "leaf", NULL));
    check(quasimc_scene_set_name(scene, 1, "lower leaf"));
    check(quasimc_scene_set_name(scene, 2, "upper leaf"));
}

static void print_light(const quasimc_result* result) {
    const int64_t count = quasimc_result_organ_count(result);
    double* mean = malloc(2 * (size_t)count * sizeof *mean);
    double* error = mean + count;
    if (mean == NULL) {
        exit(1);
    }
    check(quasimc_result_get(result, "absorbed_flux", "PAR", "mean", mean, count));
    check(quasimc_result_get(result, "absorbed_flux", "PAR", "standard_error", error, count));
    for (int64_t i = 0; i < count; ++i) {
        printf("%s: %.3f W, standard error %.3f\n", quasimc_result_organ_name(result, i), mean[i],
               error[i]);
    }
    free(mean);
}

int main(void) {
    const double leaf_reflectance[] = {0.10}, leaf_transmittance[] = {0.05};
    const double soil_reflectance[] = {0.15};
    const double sun[] = {400}, sky[] = {100};
    quasimc_scene* scene = NULL;
    quasimc_result* result = NULL;

    check(quasimc_scene_new(&scene));
    check(quasimc_scene_add_band(scene, "PAR", "W m-2"));
    check(quasimc_scene_add_material(scene, "leaf", leaf_reflectance, leaf_transmittance));
    check(quasimc_scene_add_material(scene, "soil", soil_reflectance, NULL));
    add_leaves(scene);
    check(quasimc_scene_set_ground(scene, "soil", 0));
    check(quasimc_scene_add_sun(scene, 135, 50, sun));
    check(quasimc_scene_add_sky(scene, "uniform", sky));
    check(quasimc_scene_set_option(scene, "paths", "4096"));

    check(quasimc_scene_run(scene, NULL, NULL, &result));
    print_light(result);

    quasimc_result_free(result);
    quasimc_scene_free(scene);
    return 0;
}
