-- RiMEA test 1: 40 m at 1.33 m/s take 30 s; with a body of 40 cm, speed steps of 0.05 m/s and a
-- reaction time of 1 s: 26 to 34 s.
SELECT model, 'time for 40 m, s', avg(value), 26, 34, 1
FROM measured WHERE metric = 'travel_time' GROUP BY model ORDER BY model DESC;
