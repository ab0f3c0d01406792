-- RiMEA test 9: half the exits, about twice the time. Means over the repetitions.
WITH mean AS (
  SELECT model, scenario, avg(value) AS time_s, count(value) = count(*) AS all_out
  FROM measured WHERE metric = 'evacuation_time' GROUP BY model, scenario ORDER BY model DESC, scenario)
SELECT model, scenario || ': everybody out after, s', iif(all_out, time_s, NULL), NULL, NULL, 1 FROM mean
UNION ALL
SELECT two.model, 'time by two exits over that by four', iif(two.all_out AND four.all_out, two.time_s / four.time_s, NULL),
       1.6, 2.4, 1
FROM mean AS two JOIN mean AS four USING (model)
WHERE two.scenario = 'two_exits' AND four.scenario = 'four_exits';
