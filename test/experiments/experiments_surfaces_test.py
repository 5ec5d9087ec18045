#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The experiments on surfaces: fits, distances and angles against hand-computed values, orders in tiny settings.

SUBDIVIDE_VOLUME names the program (see experiments/common.py for where else it is looked for).
"""
import pathlib
import sys
import tempfile
import unittest

import numpy as np
from scipy.spatial.transform import Rotation

EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "experiments"
sys.path.insert(0, str(EXPERIMENTS))

import fitting  # noqa: E402
import meshes  # noqa: E402
import metrology  # noqa: E402
import noise  # noqa: E402
import rendering  # noqa: E402
import shapes  # noqa: E402
import smoothness  # noqa: E402
import specimen  # noqa: E402
import surfaces  # noqa: E402
from report import Finding  # noqa: E402
from volumes import Volume  # noqa: E402

TILTED = np.array([2.0, 1.0, 2.0]) / 3.0


def square(height, side=1.0, corner=(0.0, 0.0)):
    """Two triangles in the plane z = height, facing upwards: the cross product in [z, y, x] has positive z."""
    y, x = corner
    points = [(height, y, x), (height, y + side, x), (height, y + side, x + side), (height, y, x + side)]
    return meshes.Mesh(np.array(points, dtype=float), np.array([(0, 1, 2), (0, 2, 3)]))


def cylinder_points(radius, axis=(1.0, 0.0, 0.0), centre=(0.0, 0.0, 0.0), lower=-1.0, upper=1.0, wave=0.0):
    """A grid of points on a cylinder; its radius varies by wave * cos(3 * angle)."""
    along, angle = np.meshgrid(np.linspace(lower, upper, 9), np.arange(36) * np.pi / 18, indexing="ij")
    first = shapes.unit(np.cross(axis, (0.0, 0.3, 1.0)))
    second = np.cross(axis, first)
    reach = (radius + wave * np.cos(3 * angle))[..., None]
    around = np.cos(angle)[..., None] * first + np.sin(angle)[..., None] * second
    return (np.asarray(centre) + along[..., None] * np.asarray(axis) + reach * around).reshape(-1, 3)


def ring_points(height, inner, outer):
    """A grid of points on a flat ring about the z axis."""
    radius, angle = np.meshgrid(np.linspace(inner, outer, 7), np.arange(36) * np.pi / 18, indexing="ij")
    return np.stack([np.full_like(radius, height), radius * np.cos(angle), radius * np.sin(angle)], -1).reshape(-1, 3)


class Fits(unittest.TestCase):
    def test_plane_through_exact_points(self):
        turn = np.cross((1.0, 0.0, 0.0), TILTED)
        rotation = Rotation.from_rotvec(shapes.unit(turn) * np.arccos(TILTED[0]))
        plane = fitting.fit_plane(rotation.apply(ring_points(1.5, 0.2, 2.0)))
        self.assertAlmostEqual(abs(plane.normal @ TILTED), 1.0, places=12)
        self.assertAlmostEqual(plane.distance_to(np.zeros(3)), 1.5, places=12)

    def test_cylinder_from_exact_points_and_a_guess_ten_degrees_off(self):
        guess = Rotation.from_euler("x", 10, degrees=True).apply(TILTED)
        fitted = fitting.fit_cylinder(cylinder_points(2.5, TILTED, (3.0, -1.0, 4.0)), guess)
        self.assertAlmostEqual(fitted.diameter, 5.0, places=8)
        self.assertAlmostEqual(fitted.axis @ TILTED, 1.0, places=10)
        self.assertAlmostEqual(fitted.roundness, 0.0, places=7)
        off_axis = np.cross(fitted.centre - (3.0, -1.0, 4.0), TILTED)
        np.testing.assert_allclose(off_axis, 0.0, atol=1e-7)

    def test_three_lobes_of_height_a_tenth_leave_the_radius_and_show_as_roundness(self):
        fitted = fitting.fit_cylinder(cylinder_points(2.0, wave=0.1), (1.0, 0.0, 0.0))
        self.assertAlmostEqual(fitted.radius, 2.0, places=8)
        self.assertAlmostEqual(fitted.roundness, 0.2, places=7)

    def test_perpendicularity_of_a_leaning_face(self):
        leaning = Rotation.from_euler("y", 30, degrees=True).apply(ring_points(0.0, 0.5, 2.0))
        plane = fitting.fit_plane(leaning)
        lean = np.degrees(np.arccos(abs(plane.normal[0])))
        self.assertAlmostEqual(lean, 30.0, places=8)
        self.assertAlmostEqual(fitting.perpendicularity(plane, np.array([1.0, 0, 0]), 4.0), 2.0, places=10)

    def test_concentricity_is_twice_the_offset_at_the_worse_end(self):
        datum = fitting.FittedCylinder(np.zeros(3), np.array([1.0, 0.0, 0.0]), 1.0, 0.0)
        shifted = fitting.FittedCylinder(np.array([5.0, 0.3, 0.4]), np.array([1.0, 0.0, 0.0]), 1.0, 0.0)
        self.assertAlmostEqual(fitting.concentricity(shifted, datum, 2.0), 1.0, places=12)
        leaning = fitting.FittedCylinder(np.array([0.0, 0.1, 0.0]), np.array([0.8, 0.6, 0.0]), 1.0, 0.0)
        self.assertAlmostEqual(fitting.concentricity(leaning, datum, 2.0), 2 * (0.1 + 0.6), places=12)


class Meshes(unittest.TestCase):
    def test_areas(self):
        np.testing.assert_allclose(square(0.0, 2.0).areas(), [2.0, 2.0])
        # The diagonal's two corners touch both triangles.
        np.testing.assert_allclose(square(0.0, 2.0).point_areas(), [4 / 3, 2 / 3, 4 / 3, 2 / 3])

    def test_select_keeps_what_the_triangles_use(self):
        kept = square(0.0).select(np.array([False, True]))
        np.testing.assert_array_equal(kept.points, square(0.0).points[[0, 2, 3]])
        np.testing.assert_array_equal(kept.triangles, [[0, 1, 2]])

    def test_largest_piece_has_the_most_triangles(self):
        strip = meshes.Mesh(square(1.0).points + (0, 5, 0), np.array([(0, 1, 2)]))
        both = meshes.Mesh(
            np.concatenate([strip.points, square(0.0).points]),
            np.concatenate([strip.triangles, square(0).triangles + 4]),
        )
        np.testing.assert_array_equal(both.largest_piece().points, square(0.0).points)
        np.testing.assert_array_equal(both.largest_piece().triangles, square(0.0).triangles)

    def test_distance_is_to_the_nearest_triangle_not_to_the_nearest_point(self):
        small = square(0.25, 1.0, (4.0, 4.0))
        of_small, of_large = meshes.point_distances(small, square(0.0, 10.0))
        np.testing.assert_allclose(of_small, 0.25, atol=1e-6)
        # The corners (0, 0), (10, 0), (10, 10) and (0, 10) and the nearest ones of the square from 4 to 5.
        np.testing.assert_allclose(of_large**2 - 0.0625, [32, 41, 50, 41], rtol=1e-5)

    def test_symmetric_distance_weights_by_area(self):
        first = square(0.0, 4.0)
        second = square(0.5, 4.0)
        # A spike in the second: its own small square, two up.
        spike = square(2.0, 1.0, (1.0, 1.0))
        second = meshes.Mesh(
            np.concatenate([second.points, spike.points]), np.concatenate([second.triangles, spike.triangles + 4])
        )
        measured = meshes.mesh_distance(first, second)
        # Areas 16 and 16 at a distance of 0.5, and 1 at 2.
        self.assertAlmostEqual(measured.mean, (32 * 0.5 + 1 * 2.0) / 33, places=6)
        self.assertAlmostEqual(measured.q95, 0.5, places=6)
        self.assertAlmostEqual(measured.maximum, 2.0, places=6)

    def test_weighted_quantile(self):
        values, weights = np.array([3.0, 1.0, 2.0]), np.array([0.1, 0.5, 0.4])
        for fraction, expected in ((0.4, 1.0), (0.6, 2.0), (0.95, 3.0)):
            self.assertEqual(meshes.weighted_quantile(values, weights, fraction), expected)

    def test_normal_angle_of_a_square_facing_up(self):
        mesh = square(0.0, 3.0)
        up_and_leaning = np.array([[1.0, 0.0, 0.0], [np.cos(np.pi / 6), np.sin(np.pi / 6), 0.0]])
        angles, areas = meshes.normal_angles(mesh, up_and_leaning)
        np.testing.assert_allclose(angles, [0.0, 30.0], atol=1e-5)
        np.testing.assert_allclose(areas, [4.5, 4.5])

    def test_isosurface_lies_where_the_voxels_are_and_faces_low_values(self):
        fine = np.broadcast_to(np.arange(16) / 2 - 0.25, (16, 16, 16))
        mesh = meshes.isosurface(fine, 3.3, parts=2, spacing=(1.0, 1.0, 0.5))
        np.testing.assert_allclose(mesh.points[:, 2], 3.3 * 0.5, atol=1e-6)
        self.assertAlmostEqual(mesh.points[:, 0].min(), -0.25)
        self.assertAlmostEqual(mesh.points[:, 0].max(), 7.25)
        angles, _ = meshes.normal_angles(mesh, np.broadcast_to([0.0, 0.0, -1.0], (len(mesh.triangles), 3)))
        np.testing.assert_allclose(angles, 0.0, atol=0.1)

    def test_surface_nets_lie_around_the_labelled_voxels_and_face_out(self):
        block = np.zeros((12, 12, 12), dtype=np.float32)
        block[3:9, 2:9, 4:9] = 1.0
        mesh = meshes.surface_nets(block)
        centre = np.array([5.5, 5.0, 6.0])
        lowest, highest = mesh.points.min(axis=0), mesh.points.max(axis=0)
        np.testing.assert_allclose((lowest + highest) / 2, centre, atol=0.05)
        # Smoothing takes at most half a voxel off each side.
        self.assertTrue((highest - lowest <= (6, 7, 5)).all() and (highest - lowest >= (5, 6, 4)).all())
        outwards = np.einsum("ij,ij->i", mesh.cross_products(), mesh.centroids() - centre)
        self.assertTrue((outwards > 0).all())

    def test_windowed_sinc_smooths_steps_and_keeps_the_sphere_in_its_place(self):
        sphere = shapes.Sphere((15.3, 15.9, 16.2), 9.0)
        stepped = meshes.isosurface(shapes.labels(sphere, 32), 0.5)
        before, after = (noise.measure(mesh, sphere) for mesh in (stepped, meshes.smoothed(stepped, 0.02)))
        self.assertLess(3 * after["angle"], before["angle"])
        self.assertLess(abs(after["bias"] - before["bias"]), 0.02)


class Shapes(unittest.TestCase):
    def test_normals_are_the_gradient_of_the_distance(self):
        points = np.random.default_rng(1).uniform(8, 24, size=(50, 3))
        steps = np.eye(3) * 1e-5
        for name, shape in smoothness.exact_shapes(32).items():
            with self.subTest(name):
                gradient = [(shape.distance(points + s) - shape.distance(points - s)) / 2e-5 for s in steps]
                np.testing.assert_allclose(shape.normals(points), np.stack(gradient, -1), atol=1e-6)

    def test_distances_by_hand(self):
        at = np.array([[0.0, 3.0, 4.0]])
        self.assertAlmostEqual(shapes.Sphere((0, 0, 0), 2.0).distance(at)[0], 3.0)
        self.assertAlmostEqual(shapes.Cylinder((0, 0, 0), (0, 1, 0), 1.0).distance(at)[0], 3.0)
        self.assertAlmostEqual(shapes.Torus((0, 0, 0), (1, 0, 0), 2.0, 1.0).distance(at)[0], 2.0)
        self.assertAlmostEqual(shapes.Plane((0, 1, 0), (0, 1, 0)).distance(at)[0], 2.0)

    def test_partial_volume_of_a_plane_is_what_it_cuts_off(self):
        row = shapes.partial_volume(shapes.Plane((0, 0, 3.3), (0, 0, 1)), 8)[2, 5]
        np.testing.assert_allclose(row, [1, 1, 1, 0.8, 0, 0, 0, 0], atol=1e-6)
        self.assertEqual(shapes.labels(shapes.Plane((0, 0, 3.3), (0, 0, 1)), 8)[2, 5].tolist(), [1] * 4 + [0] * 4)

    def test_partial_volume_of_a_sphere_adds_up_to_its_volume(self):
        total = shapes.partial_volume(shapes.Sphere((11.7, 12.1, 11.9), 9.0), 24).sum(dtype=float)
        self.assertAlmostEqual(total / (4 / 3 * np.pi * 9.0**3), 1.0, delta=1e-4)


class Specimen(unittest.TestCase):
    def exact_points(self):
        """Points on every cylinder and face of the specimen."""
        cylinders = [cylinder_points(r, lower=lo + 0.26, upper=up - 0.26) for r, lo, up in metrology_regions()]
        faces = [ring_points(h, inner + 0.26, outer - 0.26) for h, inner, outer in specimen.FACES.values()]
        return np.concatenate(cylinders + faces)

    def test_distance_is_zero_on_its_surface_and_signed_beside_it(self):
        for seed in (0, 1):
            pose = specimen.random_pose(np.random.default_rng(seed), 0.05)
            placed = specimen.Specimen(pose, 144, 0.05)

            def distance(local, placed=placed, pose=pose):
                in_scan = pose.rotation.apply(local) + pose.shift
                return placed.distance(in_scan / 0.05 + 71.5)

            np.testing.assert_allclose(distance(self.exact_points()), 0.0, atol=1e-9)
            # Inside a wall and inside the bore, above the top, and in the metal between two steps' solids.
            by_hand = {(0.0, 1.7, 0.0): -16.0, (0.0, 0.0, 0.3): 12.0, (3.5, 1.0, 0.0): 10.0, (1.0, 0.0, 1.5): -8.0}
            # At the bore's open end, and where its two wider steps meet.
            by_hand |= {(-3.0, 0.0, 0.4): 16.0, (-1.1, 0.3, 0.0): 12.0}
            for local, expected in by_hand.items():
                self.assertAlmostEqual(float(distance(np.array([local]))[0]), expected, places=9)

    def test_measuring_exact_points_finds_no_deviation(self):
        for quantity, values in metrology.measure(self.exact_points()).items():
            with self.subTest(quantity):
                np.testing.assert_allclose(values, 0.0, atol=1e-3)
        counts = {quantity: len(values) for quantity, values in metrology.measure(self.exact_points()).items()}
        self.assertEqual((counts["diameter"], counts["roundness"], counts["distance"]), (6, 6, 3))

    def test_measuring_points_moved_by_known_amounts_finds_them(self):
        grown = self.exact_points() * (1.002, 1.001, 1.001)
        measured = metrology.measure(grown)
        true_diameters = np.array([2 * radius for radius, _, _ in metrology_regions()])
        np.testing.assert_allclose(measured["diameter"], true_diameters * 0.001 * 1000, atol=1e-3)
        np.testing.assert_allclose(measured["distance"], np.array([2.0, 4.0, 6.0]) * 0.002 * 1000, atol=1e-3)
        np.testing.assert_allclose(measured["concentricity"], 0.0, atol=1e-3)

    def test_scans_follow_their_seed(self):
        first, again, other = (specimen.scan(seed, 36, 0.2)[1] for seed in (3, 3, 4))
        self.assertEqual(first.dtype, np.uint16)
        np.testing.assert_array_equal(first, again)
        self.assertGreater(np.count_nonzero(first != other), first.size // 2)

    def test_iso50_is_half_way_between_air_and_metal(self):
        _, volume = specimen.scan(0, 72, 0.1)
        contrast = specimen.ALUMINIUM - specimen.AIR
        self.assertAlmostEqual(metrology.iso50(volume), (specimen.ALUMINIUM + specimen.AIR) / 2, delta=0.001 * contrast)

    def test_statistics_take_the_sizes(self):
        average, deviation, maximum, q95 = metrology.statistics(np.array([-3.0, 1.0, 2.0]))
        self.assertEqual((average, deviation, maximum), (2.0, 1.0, 3.0))
        self.assertAlmostEqual(q95, 2.9)


def metrology_regions():
    return specimen.STEPS + specimen.BORES


class Smoothness(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        size = 32
        shape = smoothness.exact_shapes(size)["sphere"]
        cls.measured = {}
        for voxelisation, voxelise in smoothness.VOXELISATIONS.items():
            voxels = voxelise(shape, size)
            for name, method in smoothness.methods().items():
                mesh = smoothness.surface(method(voxels), shape, size)
                cls.measured[voxelisation, name] = smoothness.measure(mesh, shape)

    def test_nonoscillatory_normals_are_truer_than_the_original_the_peers_and_the_linear_schemes(self):
        as_smooth = {"non-oscillatory", "B-spline subdivision", "restored", "restored, tension 0"}
        others = set(smoothness.methods()) - as_smooth
        for voxelisation in smoothness.VOXELISATIONS:
            for statistic in ("angle_mean", "angle_q95"):
                ours = self.measured[voxelisation, "non-oscillatory"][statistic]
                for other in others:
                    with self.subTest(voxelisation=voxelisation, statistic=statistic, other=other):
                        self.assertLess(2 * ours, self.measured[voxelisation, other][statistic])

    def test_the_sphere_shrinks_a_little_and_more_than_with_the_linear_scheme(self):
        ours, linear = (
            self.measured["partial volume", name]["distance_mean"] for name in ("non-oscillatory", "linear subdivision")
        )
        self.assertLess(ours, linear)
        self.assertLess(-0.1, ours)

    def test_every_doubled_surface_lies_where_the_sphere_is(self):
        """A shift by a quarter of a voxel (a wrong position of the children) would show as an RMS above 0.2."""
        for name in set(smoothness.methods()) - {"nearest voxel"}:
            with self.subTest(name):
                self.assertLess(self.measured["partial volume", name]["distance_rms"], 0.1)


class Metrology(unittest.TestCase):
    def test_subdivision_keeps_the_fits_within_a_tenth_of_a_voxel_of_the_original(self):
        setting = metrology.Setting(scans=1, size=72, voxel=0.1)
        deviations, _ = metrology.measure_scans(setting)
        for method in metrology.METHODS:
            for quantity in ("diameter", "distance"):
                with self.subTest(method=method, quantity=quantity):
                    change = deviations[quantity, method] - deviations[quantity, "original"]
                    self.assertLess(np.abs(change).max(), 10.0)
        table = metrology.table(deviations)
        self.assertEqual(len(table.rows), len(metrology.QUANTITIES) * len(metrology.METHODS))


class Surfaces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """A ball with a little noise in 56 voxels, longer along z."""
        ball = shapes.partial_volume(shapes.Sphere((27.5, 27.8, 27.1), 18.0), 56)
        noise = np.random.default_rng(7).normal(0, 0.01, ball.shape)
        cls.case = surfaces.prepare(
            Volume("ball", (100 * (ball + noise)).astype(np.float32), (0.3, 0.2, 0.2)), 50.0, 56
        )

    def test_the_pit_goes_to_the_surface_and_opens_outwards(self):
        away = (self.case.place - (27.5, 27.8, 27.1)) * self.case.sides
        np.testing.assert_allclose(self.case.sides, [1.5, 1.0, 1.0])
        self.assertLess(abs(np.linalg.norm(away / self.case.sides) - 18.0), 1.0)
        self.assertGreater(shapes.unit(away) @ self.case.opening, 0.9)

    def test_a_pit_removes_a_ball_of_material(self):
        block = np.full((16, 16, 24), 10.0, dtype=np.float32) * (np.arange(24) > 7)
        removed = (block.sum() - surfaces.with_pit(block, (8, 8, 14), 3.0).sum()) / 10.0
        self.assertAlmostEqual(removed / (4 / 3 * np.pi * 27), 1.0, delta=0.005)

    def test_the_box_around_a_place_starts_evenly_and_stays_inside(self):
        starts, box = surfaces.around((3, 30, 57), (60, 61, 60), 24)
        self.assertEqual(starts, [0, 18, 36])
        self.assertEqual([(b.start, b.stop) for b in box], [(0, 24), (18, 42), (36, 60)])

    def test_linear_is_nearest_the_original_and_the_pit_stays_visible(self):
        _, measured = surfaces.measure(self.case)
        self.assertLess(measured["linear subdivision"].distance.mean, measured["non-oscillatory"].distance.mean)
        self.assertLess(measured["linear subdivision"].distance.mean, measured["nearest voxel"].distance.mean)
        depths = surfaces.pit_depths(self.case)
        for finding in surfaces.findings({"ball": measured}, {"ball": depths}):
            self.assertTrue(finding.holds, finding.claim)
        for method, by_radius in depths.items():
            with self.subTest(method):
                self.assertEqual(by_radius, sorted(by_radius))
        self.assertGreater(depths["original"][2], 2.5)

    def test_a_pit_that_is_gone_is_not_called_visible(self):
        _, measured = surfaces.measure(self.case)
        gone = {name: [0.0] * len(surfaces.PIT_RADII) for name in measured}
        gone["original"] = list(surfaces.PIT_RADII)
        visible = next(iter(surfaces.findings({"ball": measured}, {"ball": gone})))
        self.assertIsInstance(visible, Finding)
        self.assertFalse(visible.holds)


class Rendering(unittest.TestCase):
    SCALE = rendering.Scale("value", 0.0, 1.0, "viridis")

    def render(self, values):
        view = rendering.View((0.0, 0.5, 0.5), (1.0, 0.0, 0.0), 1.0)
        return rendering.render(rendering.Panel("", square(0.0), np.array(values)), view, self.SCALE)

    def test_a_square_shows_in_its_colour_on_white(self):
        image = self.render([0.0, 0.0])
        middle, corner = image[len(image) // 2, len(image) // 2], image[4, 4]
        np.testing.assert_array_equal(corner, [255, 255, 255])
        np.testing.assert_allclose(middle, np.array(self.SCALE.mappable().to_rgba(0.0)[:3]) * 255, atol=6)
        # The square is half as high and as wide as the view.
        covered = np.mean(np.any(image != 255, axis=2))
        self.assertAlmostEqual(covered, 0.25, delta=0.01)

    def test_the_two_triangles_are_where_they_belong(self):
        """Seen from above, y runs up and x to the right: triangle 0 has a corner at y = 1, x = 0."""
        image = self.render([0.0, 1.0]).astype(int)
        quarter = len(image) // 8
        middle = len(image) // 2
        above_left, below_right = image[middle - quarter, middle - quarter], image[middle + quarter, middle + quarter]
        low, high = (np.array(self.SCALE.mappable().to_rgba(v)[:3]) * 255 for v in (0.0, 1.0))
        np.testing.assert_allclose(above_left, low, atol=6)
        np.testing.assert_allclose(below_right, high, atol=6)

    def test_panels_become_one_picture(self):
        panels = [rendering.Panel(str(k), square(0.0), np.zeros(4)) for k in range(3)]
        view = rendering.View((0.0, 0.5, 0.5), (1.0, 0.0, 0.0), 1.0)
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(rendering.draw(panels, view, self.SCALE, 2, folder, "a.png"), "a.png")
            self.assertGreater((pathlib.Path(folder) / "a.png").stat().st_size, 1000)


if __name__ == "__main__":
    unittest.main()
