-- RiMEA test 4: Weidmann's curve, v = 1.34 (1 - exp(-1.913 (1 / density - 1 / 5.4))) m/s. Judged at 0.5, 1, 2 and 3
-- people/m2. ORCA slows down only to avoid collisions, so it is known to be too fast.
WITH point AS (
  SELECT speed.model, density.value AS density, speed.value AS speed,
         1.34 * (1 - exp(-1.913 * (1 / density.value - 1 / 5.4))) AS weidmann
  FROM measured AS speed JOIN measured AS density USING (model, scenario, repetition)
  WHERE speed.metric = 'walking_speed' AND density.metric = 'density')
SELECT model, printf('speed at %.4g people/m2, m/s', density), speed, weidmann - 0.3, weidmann + 0.3,
       model <> 'ORCA' AND round(density, 6) IN (0.5, 1, 2, 3)
FROM point ORDER BY model DESC, density;
