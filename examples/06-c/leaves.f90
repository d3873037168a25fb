! Two leaves, one half above the other, over soil, under sun and sky: the light that each absorbs.
! The functions of the C interface that are used here stand in the module; others are declared alike.

module quasimc
  use, intrinsic :: iso_c_binding
  implicit none

  interface
    integer(c_int) function quasimc_scene_new(scene) bind(c)
      import
      type(c_ptr), intent(out) :: scene
    end function

    subroutine quasimc_scene_free(scene) bind(c)
      import
      type(c_ptr), value :: scene
    end subroutine

    integer(c_int) function quasimc_scene_add_band(scene, name, unit) bind(c)
      import
      type(c_ptr), value :: scene
      character(kind=c_char), intent(in) :: name(*), unit(*)
    end function

    integer(c_int) function quasimc_scene_add_material(scene, name, reflectance, transmittance) bind(c)
      import
      type(c_ptr), value :: scene
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(in) :: reflectance(*), transmittance(*)
    end function

    integer(c_int) function quasimc_scene_add_mesh(scene, vertices, vertex_count, faces, face_count, &
                                                   organ_of_face, materials, material_of_face) bind(c)
      import
      type(c_ptr), value :: scene, material_of_face
      real(c_double), intent(in) :: vertices(3, *)
      integer(c_int64_t), value :: vertex_count, face_count
      integer(c_int32_t), intent(in) :: faces(3, *)
      integer(c_int64_t), intent(in) :: organ_of_face(*)
      character(kind=c_char), intent(in) :: materials(*)
    end function

    integer(c_int) function quasimc_scene_set_name(scene, organ, name) bind(c)
      import
      type(c_ptr), value :: scene
      integer(c_int64_t), value :: organ
      character(kind=c_char), intent(in) :: name(*)
    end function

    integer(c_int) function quasimc_scene_set_ground(scene, material, height) bind(c)
      import
      type(c_ptr), value :: scene
      character(kind=c_char), intent(in) :: material(*)
      real(c_double), value :: height
    end function

    integer(c_int) function quasimc_scene_add_sun(scene, azimuth_deg, elevation_deg, irradiance_facing) bind(c)
      import
      type(c_ptr), value :: scene
      real(c_double), value :: azimuth_deg, elevation_deg
      real(c_double), intent(in) :: irradiance_facing(*)
    end function

    integer(c_int) function quasimc_scene_add_sky(scene, model, irradiance_horizontal) bind(c)
      import
      type(c_ptr), value :: scene
      character(kind=c_char), intent(in) :: model(*)
      real(c_double), intent(in) :: irradiance_horizontal(*)
    end function

    integer(c_int) function quasimc_scene_set_option(scene, key, value) bind(c)
      import
      type(c_ptr), value :: scene
      character(kind=c_char), intent(in) :: key(*), value(*)
    end function

    integer(c_int) function quasimc_scene_run(scene, progress, user, result) bind(c)
      import
      type(c_ptr), value :: scene, user
      type(c_funptr), value :: progress
      type(c_ptr), intent(out) :: result
    end function

    subroutine quasimc_result_free(result) bind(c)
      import
      type(c_ptr), value :: result
    end subroutine

    integer(c_int64_t) function quasimc_result_organ_count(result) bind(c)
      import
      type(c_ptr), value :: result
    end function

    type(c_ptr) function quasimc_result_organ_name(result, organ) bind(c)
      import
      type(c_ptr), value :: result
      integer(c_int64_t), value :: organ
    end function

    integer(c_int) function quasimc_result_get(result, quantity, band, statistic, values, count) bind(c)
      import
      type(c_ptr), value :: result
      character(kind=c_char), intent(in) :: quantity(*), band(*), statistic(*)
      real(c_double), intent(out) :: values(*)
      integer(c_int64_t), value :: count
    end function

    type(c_ptr) function quasimc_last_error() bind(c)
      import
    end function

    integer(c_size_t) function strlen(text) bind(c)
      import
      type(c_ptr), value :: text
    end function
  end interface

contains

  !> A text of Fortran from one of C.
  function text_of(pointer) result(text)
    type(c_ptr), intent(in) :: pointer
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: i, length
    length = int(strlen(pointer))
    call c_f_pointer(pointer, letters, [length])
    allocate (character(len=length) :: text)
    do i = 1, length
      text(i:i) = letters(i)
    end do
  end function

  !> Ends the program if a call failed.
  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status == 0) return
    print '(a)', text_of(quasimc_last_error())
    error stop 1
  end subroutine
end module

program leaves
  use quasimc
  implicit none
  character, parameter :: nul = c_null_char
  integer(c_int64_t), parameter :: one = 1
  ! Each column a triangle; corners are counted from 0.
  integer(c_int32_t), parameter :: faces(3, 4) = reshape([0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7], [3, 4])
  integer(c_int64_t), parameter :: organs(4) = [1, 1, 2, 2]
  type(c_ptr) :: scene, result
  integer(c_int64_t) :: i, organ_count
  real(c_double), allocatable :: mean(:), error(:)

  call check(quasimc_scene_new(scene))
  call check(quasimc_scene_add_band(scene, 'PAR'//nul, 'W m-2'//nul))
  call check(quasimc_scene_add_material(scene, 'leaf'//nul, [0.10_c_double], [0.05_c_double]))
  call check(quasimc_scene_add_material(scene, 'soil'//nul, [0.15_c_double], [0._c_double]))
  call check(quasimc_scene_add_mesh(scene, corners(), 8_c_int64_t, faces, 4_c_int64_t, organs, &
                                    'leaf'//nul, c_null_ptr))
  call check(quasimc_scene_set_name(scene, one, 'lower leaf'//nul))
  call check(quasimc_scene_set_name(scene, 2_c_int64_t, 'upper leaf'//nul))
  call check(quasimc_scene_set_ground(scene, 'soil'//nul, 0._c_double))
  call check(quasimc_scene_add_sun(scene, 135._c_double, 50._c_double, [400._c_double]))
  call check(quasimc_scene_add_sky(scene, 'uniform'//nul, [100._c_double]))
  call check(quasimc_scene_set_option(scene, 'paths'//nul, '4096'//nul))

  call check(quasimc_scene_run(scene, c_null_funptr, c_null_ptr, result))
  organ_count = quasimc_result_organ_count(result)
  allocate (mean(organ_count), error(organ_count))
  call check(quasimc_result_get(result, 'absorbed_flux'//nul, 'PAR'//nul, 'mean'//nul, mean, organ_count))
  call check(quasimc_result_get(result, 'absorbed_flux'//nul, 'PAR'//nul, 'standard_error'//nul, error, organ_count))
  do i = 1, organ_count
    print '(a, ": ", f0.3, " W, standard error ", f5.3)', &
      text_of(quasimc_result_organ_name(result, i - 1)), mean(i), error(i)
  end do
  call quasimc_result_free(result)
  call quasimc_scene_free(scene)

contains

  !> The corners of two square leaves, the upper one half beside the lower.
  function corners() result(points)
    real(c_double) :: points(3, 8)
    points(:, 1) = [0._c_double, 0._c_double, 0.2_c_double]
    points(:, 2) = [0.1_c_double, 0._c_double, 0.2_c_double]
    points(:, 3) = [0.1_c_double, 0.1_c_double, 0.2_c_double]
    points(:, 4) = [0._c_double, 0.1_c_double, 0.2_c_double]
    points(:, 5) = [0.05_c_double, 0._c_double, 0.3_c_double]
    points(:, 6) = [0.15_c_double, 0._c_double, 0.3_c_double]
    points(:, 7) = [0.15_c_double, 0.1_c_double, 0.3_c_double]
    points(:, 8) = [0.05_c_double, 0.1_c_double, 0.3_c_double]
  end function
end program
