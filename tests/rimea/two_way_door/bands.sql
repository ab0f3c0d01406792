-- Two-way door: everybody has gone through within 240 s, with every seed. ORCA is reported.
SELECT model, 'seeds with people who did not get through', sum(value > 0), 0, 0, model <> 'ORCA'
FROM measured WHERE metric = 'people_left_behind' GROUP BY model ORDER BY model DESC;
SELECT model, 'time until the last one has, mean, s', avg(value), NULL, NULL, 0
FROM measured WHERE metric = 'evacuation_time' GROUP BY model ORDER BY model DESC;
SELECT model, 'longest, s', max(value), NULL, NULL, 0
FROM measured WHERE metric = 'evacuation_time' GROUP BY model ORDER BY model DESC;
